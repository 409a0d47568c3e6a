#include "experiments/subjects/drawing/plane_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/config/config.h"
#include "geometry/core/error.h"
#include "geometry/plane/locator.h"

namespace deformlab {
namespace {

constexpr double kRing = 0.04;  // radius, as a part of the drawing's diagonal

ConfigNode scalar(const ConfigNode& like, const std::string& text) {
  ConfigNode node = like;
  node.kind = ConfigNode::Kind::kScalar;
  node.key.clear();
  node.text = text;
  node.children.clear();
  return node;
}

bool is_number(const ConfigNode& node) { return node.kind == ConfigNode::Kind::kScalar; }

// Turns [x, y] into [x, y, 0].
void lift_point(ConfigNode& node, const std::string& name) {
  if (node.kind != ConfigNode::Kind::kList || node.children.size() != 2) {
    throw_wrong_value(node, name, "two coordinates [x, y]");
  }
  node.children.push_back(scalar(node, "0"));
}

// Turns `rotate: 30` into {axis: [0, 0, 1], degrees: 30}, and {degrees: 30, center: [x, y]}
// likewise.
void lift_rotation(ConfigNode& node) {
  if (is_number(node)) {
    ConfigNode degrees = node;
    degrees.key = "degrees";
    node.kind = ConfigNode::Kind::kMap;
    node.children = {degrees};
  }
  if (node.kind != ConfigNode::Kind::kMap) return;
  if (node.find("axis")) {
    throw InputError(
        fmt::format("a drawing turns in its plane: leave 'axis' out ({})", node.where()));
  }
  if (ConfigNode* center = node.find("center")) lift_point(*center, "rotate.center");
  ConfigNode axis = scalar(node, "");
  axis.kind = ConfigNode::Kind::kList;
  axis.key = "axis";
  for (const char* number : {"0", "0", "1"}) axis.children.push_back(scalar(node, number));
  node.children.push_back(axis);
}

void lift_selection(ConfigNode& select) {
  for (const char* name : {"nearest", "point"}) {
    if (ConfigNode* place = select.find(name)) lift_point(*place, name);
  }
  if (ConfigNode* box = select.find("box")) {
    for (const char* corner : {"min", "max"}) {
      if (ConfigNode* place = box->find(corner)) lift_point(*place, std::string("box.") + corner);
    }
  }
  if (ConfigNode* circle = select.find("circle")) {
    if (ConfigNode* center = circle->find("center")) lift_point(*center, "circle.center");
    circle->key = "sphere";
  } else if (const ConfigNode* sphere = select.find("sphere")) {
    throw InputError(
        fmt::format("a drawing has no sphere; take 'circle' ({})", sphere->key_where()));
  }
}

// Turns the factor [x, y] into [x, y, 1], and one number likewise.
void lift_scale(ConfigNode& scale) {
  if (scale.kind != ConfigNode::Kind::kMap) return;
  if (ConfigNode* center = scale.find("center")) lift_point(*center, "scale.center");
  ConfigNode* factor = scale.find("factor");
  if (factor == nullptr) return;
  if (is_number(*factor)) {
    const ConfigNode number = scalar(*factor, factor->text);
    factor->kind = ConfigNode::Kind::kList;
    factor->children = {number, number};
  }
  lift_point(*factor, "scale.factor");
  factor->children.back().text = "1";
}

// Turns a 3×3 matrix of [x, y, 1] into the 4×4 matrix of [x, y, 0, 1].
void lift_matrix(ConfigNode& matrix) {
  const auto is_row = [](const ConfigNode& row) {
    return row.kind == ConfigNode::Kind::kList && row.children.size() == 3;
  };
  if (matrix.kind != ConfigNode::Kind::kList || matrix.children.size() != 3 ||
      !std::ranges::all_of(matrix.children, is_row)) {
    throw InputError(fmt::format(
        "wrong value for 'matrix' ({}): expected a list of 3 rows of 3 numbers", matrix.where()));
  }
  ConfigNode flat = matrix.children[2];
  for (ConfigNode& number : flat.children) number = scalar(number, "0");
  matrix.children.insert(matrix.children.begin() + 2, flat);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<ConfigNode>& row = matrix.children[i].children;
    row.insert(row.begin() + 2, scalar(row[0], i == 2 ? "1" : "0"));
  }
}

}  // namespace

ConfigNode in_space(const ConfigNode& edit) {
  ConfigNode lifted = edit;
  for (ConfigNode& entry : lifted.children) {
    if (ConfigNode* select = entry.find("select")) lift_selection(*select);
    for (const char* name : {"by", "to"}) {
      if (ConfigNode* place = entry.find(name)) lift_point(*place, name);
    }
    if (ConfigNode* rotate = entry.find("rotate")) lift_rotation(*rotate);
    if (ConfigNode* scale = entry.find("scale")) lift_scale(*scale);
    if (ConfigNode* matrix = entry.find("matrix")) lift_matrix(*matrix);
  }
  return lifted;
}

std::string naming_circles(std::string message) {
  constexpr std::string_view kSphere = ".sphere", kCircle = ".circle";
  for (std::size_t at = message.find(kSphere); at != message.npos; at = message.find(kSphere, at))
    message.replace(at, kSphere.size(), kCircle);
  return message;
}

std::vector<EditEntry> read_plane_edit(const ConfigNode& edit) {
  return with_circles([&] { return read_edit(in_space(edit), 2); });
}

void complete_angles(const std::vector<std::vector<EditEntry>*>& lists) {
  const auto name = [](const EditEntry& entry) { return to_yaml_line(to_node(entry.selection)); };
  std::set<std::string> turning;
  for (const std::vector<EditEntry>* list : lists) {
    for (const EditEntry& entry : *list) {
      if (entry.selection && entry.rotate) turning.insert(name(entry));
    }
  }
  for (std::vector<EditEntry>* list : lists) {
    for (EditEntry& entry : *list) {
      if (!entry.selection || entry.rotate || !turning.contains(name(entry))) continue;
      entry.rotate.emplace();
    }
  }
}

std::vector<EditEntry> on_mesh(std::vector<EditEntry> entries, const Triangulation& rest,
                               const std::function<bool(const Eigen::Vector2d&)>& belongs) {
  const Locator locate(rest);
  for (EditEntry& entry : entries) {
    if (!entry.selection || !entry.selection->point) continue;
    Eigen::Vector3d& point = *entry.selection->point;
    const Located place = locate(point.head<2>());
    if (place.distance == 0 || !belongs(point.head<2>())) continue;
    const Eigen::Vector3d nearest(place.nearest.x(), place.nearest.y(), 0);
    if (entry.to) *entry.to += nearest - point;
    if (entry.rotate && !entry.rotate->center) entry.rotate->center = point;
    point = nearest;
  }
  return entries;
}

ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Triangulation& rest) {
  const Shape shape = to_shape(rest);
  const Locator locate(rest);
  const double size = bounding_box_diagonal(shape.V);
  const auto inside = [&](const Eigen::Vector3d& p) {
    return locate(p.head<2>()).distance <= 1e-9 * size;
  };
  return resolve(entries, shape, {kRing * size, inside});
}

}  // namespace deformlab
