#include "deformers/embedded/embedded_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "energies/graph/rotation.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr double kMostUnits = 1e9;  // the greatest ratio of length_unit and mean edge, either way

void check_extra_terms(const EmbeddedDeformationOptions& options) {
  for (std::size_t i = 0; i < options.extra_terms.size(); ++i) {
    const ExtraTerm& term = options.extra_terms[i];
    const std::string name = fmt::format("extra_terms[{}]", i);
    if (!term.make) throw InputError(name + " has no function that makes it");
    if (!(term.weight >= 0 && std::isfinite(term.weight))) {
      throw InputError(fmt::format("the weight of {} is {}; a weight is a number of 0 or more",
                                   name, term.weight));
    }
    inside_option(name + ".loss", [&] { check_options(term.loss); });
  }
}

// E_rot of a rotation is zero for any weight. Every other term has to exist for rigid nodes.
void check_rotation_model(const EmbeddedDeformationOptions& o) {
  if (o.rotation_model == RotationModel::kAffine) return;
  if (o.dimension != 3) {
    throw OptionError("rotation_model", "rigid",
                      fmt::format(", which is for shapes in space, but dimension is {}; use "
                                  "rotation_model: affine",
                                  o.dimension));
  }
  for (const auto& [name, settings] : o.energies) {
    const double weight = settings.weight.value_or(0);
    if (energy_info(name).for_rigid_nodes || weight == 0 || name == Rotation<>::kName) continue;
    throw OptionError("energies." + name, fmt::format("{}", weight),
                      ", but rotation_model: rigid has no such term; make it 0, or use "
                      "rotation_model: affine");
  }
}

void check_stiffness(const Eigen::VectorXd& stiffness, Eigen::Index vertices) {
  const bool fits = stiffness.size() == 0 || stiffness.size() == vertices;
  if (fits && stiffness.allFinite() && (stiffness.array() > 0).all()) return;
  throw InputError(fmt::format(
      "the stiffness of the vertices has {} numbers for {} vertices; it needs one finite number "
      "above 0 for each, or none",
      stiffness.size(), vertices));
}

std::shared_ptr<const ceres::LossFunction> loss_of(const EmbeddedDeformationOptions& options,
                                                   const std::string& name) {
  const auto named = options.losses.find(name);
  if (named == options.losses.end()) return nullptr;
  return make_loss(named->second);
}

}  // namespace

void check(const EmbeddedDeformationOptions& options, const Shape& rest) {
  check_options(options);
  check_settings(options.energies);
  for (const auto& [name, loss] : options.losses) energy_info(name);
  check_extra_terms(options);
  check_dimension(options.dimension, rest);
  check_rotation_model(options);
  check_stiffness(options.stiffness, rest.V.cols());
}

void refuse_interior(GraphOptions& options, const std::string& why) {
  if (options.interior == InteriorNodes::kOn) {
    throw OptionError("graph.interior", "on", fmt::format(", but {}; take interior: off", why));
  }
  options.interior = InteriorNodes::kOff;
}

void check_dimension(int d, const Shape& rest) {
  if (d == 2 && rest.V.cols() > 0 && rest.V.row(2).maxCoeff() > rest.V.row(2).minCoeff()) {
    throw OptionError("dimension", "2", ", but z differs over the shape; use 3, or flatten it");
  }
}

double length_unit(const std::string& text, const DeformationGraph& graph) {
  if (text == "mean_edge") return mean_edge_length(graph);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool positive = error == std::errc() && end == text.data() + text.size() && value > 0;
  if (!positive || !std::isfinite(value)) {
    throw OptionError("length_unit", fmt::format("'{}'", text),
                      "; allowed: mean_edge, or a positive number");
  }
  const double edge = mean_edge_length(graph);
  if (value >= edge / kMostUnits && value <= edge * kMostUnits) return value;
  throw OptionError(
      "length_unit", fmt::format("'{}'", text),
      fmt::format(", but the mean edge of the graph is {:.6g}; choose a length within "
                  "a factor of {:g} of it",
                  edge, kMostUnits));
}

std::vector<TermRecipe> term_recipes(const EmbeddedDeformationOptions& options) {
  std::vector<TermRecipe> recipes;
  for (const EnergyInfo& info : known_energies()) {
    const auto named = options.energies.find(info.name);
    const TermSettings settings = named != options.energies.end() ? named->second : TermSettings{};
    const double weight = settings.weight.value_or(info.default_weight);
    const bool exists = options.node_model() == NodeModel::kAffine || info.for_rigid_nodes;
    if (!(weight > 0) || !exists) continue;
    const auto make = [name = info.name, own = settings.options](const GraphContext& context) {
      return make_energy(name, context, own);
    };
    recipes.push_back({make, weight, loss_of(options, info.name)});
  }
  for (const ExtraTerm& extra : options.extra_terms) {
    if (!(extra.weight > 0)) continue;
    recipes.push_back({extra.make, extra.weight, make_loss(extra.loss)});
  }
  return recipes;
}

}  // namespace deformlab
