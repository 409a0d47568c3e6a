#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// An axis-aligned box with its boundary [length].
struct BoxSelection {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("min", o.min, "The smallest corner [x, y, z] [length]");
    visit.required("max", o.max, "The largest corner [x, y, z] [length]");
  }
};

/// A ball with its boundary [length].
struct SphereSelection {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("center", o.center, "The centre [x, y, z] [length]");
    visit.required("radius", o.radius, {.min = 0}, "The radius [length]");
  }
};

/// What an entry of an edit selects, by rest positions. Exactly one member is given.
struct Selection {
  std::optional<std::vector<int>> vertices;
  std::optional<BoxSelection> box;
  std::optional<SphereSelection> sphere;
  std::optional<Eigen::Vector3d> nearest;
  std::optional<Eigen::Vector3d> point;
  std::optional<std::filesystem::path> file;  ///< read_selection_file turns it into `vertices`
  std::optional<bool> all;
  int dimension = 3;  ///< 2 in a drawing, whose positions messages give by two coordinates
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("vertices", o.vertices, "The indices of vertices, counted from 0");
    visit("box", o.box, "All vertices inside an axis-aligned box");
    visit("sphere", o.sphere, "All vertices inside a sphere");
    visit("nearest", o.nearest, "The one vertex that is closest to [x, y, z] [length]");
    visit("point", o.point, "A point inside the shape, which need not be a vertex [length]");
    visit("file", o.file, "A text file beside the YAML file, with one vertex index in each line");
    visit("all", o.all, "true selects every vertex");
  }
};

/// "[x, y, z]", or "[x, y]" in the plane, for messages.
std::string text_of(const Eigen::Vector3d& p, int dimension = 3);

/// Throws InputError for a flag that is given as false.
void check_only_true(const std::optional<bool>& flag, const char* name, const std::string& where);

/// Throws InputError unless the shape has such a vertex. `where` is what the message calls the
/// selection.
void check_exists(int vertex, const Shape& shape, const std::string& where);

/// Throws InputError unless exactly one selector is given, and if it cannot select anything.
void check_selection(const Selection& select, const std::string& where);

/// Reads the file of a selection, if it has one, into `vertices`. `node` is the map that the
/// selection was read from. Throws InputError for a file that does not list indices.
void read_selection_file(Selection& select, const ConfigNode& node, const std::string& where);

/// The vertices of a selection in ascending order, each once. Messages call the selection `where`.
/// Throws InputError if no vertex is selected, and for `point`, which need not be a vertex.
std::vector<int> select_vertices(const Selection& selection, const Shape& shape,
                                 const std::string& where);

}  // namespace deformlab
