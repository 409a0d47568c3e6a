#include "experiments/subjects/shape/paint.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/config/config.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

std::vector<ReadCoat> shape_coats(const ConfigNode& list) {
  std::vector<ReadCoat> coats = read_coats(list);
  for (const ReadCoat& read : coats) {
    if (!read.coat.mask) continue;
    throw InputError(fmt::format("{}: 'mask' is for drawings; give 'select'", read.where));
  }
  return coats;
}

}  // namespace

std::vector<ReadCoat> read_coats(const ConfigNode& list) {
  std::vector<ReadCoat> coats;
  if (list.kind == ConfigNode::Kind::kNull) return coats;
  check_list(list, "paint");
  for (const ConfigNode& node : list.children) {
    ReadCoat& read = coats.emplace_back();
    Coat& coat = read.coat;
    read.where = fmt::format("paint entry {} ({})", coats.size(), node.where());
    read.folder = node.folder();
    read_value(node, "paint", coat);
    if (coat.select.has_value() == coat.mask.has_value()) {
      throw InputError(fmt::format("{}: give either 'select' or 'mask'", read.where));
    }
    if (coat.select) check_selection(*coat.select, read.where);
    if (!(coat.weight > 0 && std::isfinite(coat.weight))) {
      throw InputError(
          fmt::format("{}: the weight is {:g}; allowed: greater than 0", read.where, coat.weight));
    }
    if (coat.select) read_selection_file(*coat.select, *node.find("select"), read.where);
  }
  return coats;
}

void check_shape_paint(const ConfigNode& list) { shape_coats(list); }

Eigen::VectorXd painted_stiffness(const ConfigNode& list, const Shape& rest) {
  const std::vector<ReadCoat> coats = shape_coats(list);
  if (coats.empty()) return {};
  Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(rest.V.cols());
  for (const ReadCoat& read : coats) {
    for (const int i : select_vertices(*read.coat.select, rest, read.where)) {
      stiffness[i] = read.coat.weight;
    }
  }
  return stiffness;
}

}  // namespace deformlab
