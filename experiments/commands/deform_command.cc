#include <cstdio>

#include "experiments/commands/commands.h"
#include "experiments/commands/deform_ending.h"
#include "experiments/config/config.h"
#include "experiments/config/override.h"
#include "experiments/subjects/outputs.h"
#include "experiments/subjects/run.h"
#include "experiments/subjects/shape/cuts.h"
#include "experiments/subjects/shape/edit.h"
#include "experiments/subjects/shape/pictures.h"
#include "geometry/core/error.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

/// What key=value may set.
struct DeformOptions {
  MethodOptions method;
  ConfigNode cut;
  PictureOptions picture;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    MethodOptions::fields(o.method, visit);
    visit("cut", o.cut,
          "Parts that follow no common node: a list of {between: SELECTION, and: SELECTION}");
    visit("picture", o.picture, "How the file of --picture is drawn");
  }
};

DeformOptions read_options(const std::vector<std::string>& overrides, int nodes) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  apply_override(root, {"graph.nodes", std::to_string(nodes), "."});
  for (const std::string& text : overrides) apply_override(root, parse_override(text));
  auto options = read_config<DeformOptions>(root);
  complete_energies(root, options.method.deformation);
  return options;
}

Image draw(const Deformer& deformer, const Shape& rest, const ResolvedEdit& edit,
           const PictureOptions& options) {
  PictureBook pictures{options};
  pictures.add_rest(deformer, rest, edit);
  pictures.add_deformed(deformer, edit, "deformed");
  return pictures.render();
}

void print(const Report& report, const std::string& out) {
  const Summary& s = report.solve;
  std::printf("%s after %zu steps: F %.6g -> %.6g, handles off by %.3g rms, min det R %.3g\n",
              to_string(s.status), s.iterations.size(), s.initial_cost, s.final_cost,
              report.handle_rms, report.min_det_R);
  std::printf("%d nodes, %d edges, %d unknowns; written to %s\n", report.nodes, report.edges,
              s.unknowns, out.c_str());
}

}  // namespace

int deform_command(const std::vector<std::string>& arguments, const DeformFlags& flags) {
  if (arguments.empty() || flags.edit.empty() || flags.out.empty()) {
    throw InputError(
        "deform needs a shape, an edit and an output: "
        "deformlab deform SHAPE --edit EDIT.yaml --out OUT [key=value]…");
  }
  check_outputs({arguments.front(), flags.edit},
                {{flags.out, "--out"}, {flags.metrics, "--metrics"}, {flags.picture, "--picture"}});
  check_picture_name(flags.picture);
  if (is_drawing(arguments)) return deform_drawing(arguments, flags);
  check_extension(flags.out);
  const auto options = read_options({arguments.begin() + 1, arguments.end()}, flags.nodes);
  if (!flags.picture.empty()) check(options.picture);
  const std::vector<EditEntry> entries = read_edit_file(flags.edit);
  check_cuts(options.cut);
  const Shape rest = read_shape(arguments.front());
  const ResolvedEdit edit = resolve(entries, rest);

  const std::unique_ptr<Deformer> deformer =
      make_deformer(options.method, rest, resolve_cuts(options.cut, rest));
  deformer->compile(edit.handles);
  const Report report = deformer->update(edit.targets);
  if (!has_ended_well(report)) return 1;
  write_deformed(
      report, flags, [&] { return draw(*deformer, rest, edit, options.picture); },
      [&] { write_shape(flags.out, deformer->deformed(), arguments.front()); });
  print(report, flags.out);
  return 0;
}

}  // namespace deformlab
