#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "geometry/shape/handles.h"
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
  std::optional<std::filesystem::path> file;  ///< read_edit turns it into `vertices`
  std::optional<bool> all;
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

/// A rotation of the selection. Its sign follows the right-hand rule.
struct Turn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< any length but 0
  double degrees = 0;
  std::optional<Eigen::Vector3d> center;  ///< by default the centroid of the selection
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("axis", o.axis, "The direction of the axis [x, y, z], of any length");
    visit.required("degrees", o.degrees, "The angle, by the right-hand rule [degree]");
    visit("center", o.center,
          "A point on the axis, by default the centroid of the selection [length]");
  }
};

/// One entry of an edit: a selection and what happens to it. Exactly one of fix, by, to and rotate
/// is given, or both rotate and by. Then the rotation comes before the translation.
struct EditEntry {
  Selection select;
  std::optional<bool> fix;            ///< only ever true
  std::optional<Eigen::Vector3d> by;  ///< translation [length]
  /// Where the selection goes [length]. One vertex goes to this point. Several are translated
  /// together, so that their centroid is there.
  std::optional<Eigen::Vector3d> to;
  std::optional<Turn> rotate;
  std::string where;  ///< "edit entry 2 (line 5 of edit.yaml)", for messages
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("select", o.select, "The vertices, by exactly one of the following");
    visit("fix", o.fix, "true fixes the vertices at their positions");
    visit("by", o.by, "A translation [dx, dy, dz] [length]");
    visit("to", o.to,
          "The position [x, y, z] to which the vertex, or the centroid of the selection, goes "
          "[length]");
    visit("rotate", o.rotate, "A rotation; together with 'by' it comes first");
  }
};

/// "[x, y, z]", for messages.
std::string text_of(const Eigen::Vector3d& p);

/// Reads the list under `edit:`. Throws InputError (naming the line) for anything that is not in
/// the grammar above: no selector or two, no action or two, a negative radius, min > max, a zero
/// axis, numbers that are not finite, a file of indices that cannot be read, or no entries.
std::vector<EditEntry> read_edit(const ConfigNode& list);

/// Throws InputError unless exactly one selector is given, and if it cannot select anything.
void check_selection(const Selection& select, const std::string& where);

/// Puts the list of a YAML file whose only key is `edit` into the map `root`, under that key.
/// Throws InputError as load_config does, and for another key.
void put_edit(const std::filesystem::path& path, ConfigNode& root);

/// The handles and targets of an edit for one shape. Each vertex occurs once. Vertices are in the
/// order of the entries, and ascend within an entry.
struct ResolvedEdit {
  Handles handles;
  Eigen::Matrix3Xd targets;  ///< 3×#, of handles.moved and then of handles.points [length]
};

/// A single point has no orientation. If one is rotated, a ring of points around it moves with it,
/// so that the shape follows the angle on a mesh of any resolution (Igarashi et al. 2005, Figure
/// 16).
struct Rings {
  double radius = 0;  ///< [length]; 0: there are no rings
  /// Whether a point is in the shape. Only points of a ring that are in the shape are used.
  std::function<bool(const Eigen::Vector3d&)> inside = [](const Eigen::Vector3d&) { return true; };
};

/// Selects by rest positions. A vertex that several entries move to the same position counts once.
/// Throws InputError (naming the entries) if an index does not exist, a selection is empty, a
/// vertex is both fixed and moved or moved to two positions, a target is not finite, or there are
/// no entries.
ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings = {});

/// The vertices of a selection in ascending order, each once. Messages call the selection `where`.
/// Throws InputError if no vertex is selected, and for `point`, which need not be a vertex.
std::vector<int> select_vertices(const Selection& selection, const Shape& shape,
                                 const std::string& where);

}  // namespace deformlab
