#include <fmt/format.h>

#include <cmath>

#include "experiments/config/config.h"
#include "experiments/subjects/drawing/drawing_scene.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

Eigen::Vector2d read_point(const ConfigNode& node, const std::string& name) {
  if (node.kind != ConfigNode::Kind::kList || node.children.size() != 2) {
    throw_wrong_value(node, name, "a point [x, y]");
  }
  Eigen::Vector2d point;
  for (int c = 0; c < 2; ++c) read_value(node.children[c], name, point[c]);
  return point;
}

/// One entry of `depth.parts`.
struct Level {
  Selection select;
  double level = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("select", o.select, "Vertices, selected as in an edit");
    visit.range("level", o.level, {.min = -1000, .max = 1000},
                "Parts of a higher level are in front; that of the other parts is 0");
  }
};

struct ReadLevel {
  Level level;
  std::string where;
};

std::vector<ReadLevel> read_levels(const ConfigNode& list) {
  std::vector<ReadLevel> levels;
  if (list.kind == ConfigNode::Kind::kNull) return levels;
  check_list(list, "depth.parts");
  const ConfigNode lifted = in_space(list);
  for (const ConfigNode& node : lifted.children) {
    ReadLevel& read = levels.emplace_back();
    read.where = fmt::format("depth.parts entry {} ({})", levels.size(), node.where());
    with_circles([&] { read_value(node, "depth.parts", read.level); });
    with_lines_of(node, [&] { check_options(read.level); });
    read.level.select.dimension = 2;
    check_selection(read.level.select, read.where);
  }
  return levels;
}

}  // namespace

CutLines read_cut_lines(const ConfigNode& list) {
  CutLines lines;
  if (list.kind == ConfigNode::Kind::kNull) return lines;
  check_list(list, "cut");
  for (const ConfigNode& line : list.children) {
    const std::string name = fmt::format("cut[{}]", lines.size());
    if (line.kind != ConfigNode::Kind::kList || line.children.size() < 2) {
      throw_wrong_value(line, name,
                        "a line of two or more points [[x, y], [x, y], …] for a drawing");
    }
    Eigen::Matrix2Xd& corners = lines.emplace_back(2, std::ssize(line.children));
    for (std::size_t i = 0; i < line.children.size(); ++i) {
      corners.col(static_cast<Eigen::Index>(i)) =
          read_point(line.children[i], fmt::format("{}[{}]", name, i));
    }
  }
  return lines;
}

Eigen::VectorXd depth_levels(const ConfigNode& list, const Triangulation& rest) {
  Eigen::VectorXd levels = Eigen::VectorXd::Zero(rest.V.cols());
  const Shape shape = to_shape(rest);
  for (const ReadLevel& read : read_levels(list)) {
    for (const int i : select_vertices(read.level.select, shape, read.where)) {
      levels[i] = read.level.level;
    }
  }
  return levels;
}

void check_depth_levels(const ConfigNode& list) { read_levels(list); }

}  // namespace deformlab
