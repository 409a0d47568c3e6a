#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/subjects/shape/selection.h"
#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"

namespace deformlab {

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

/// Reads the list under `edit:`. Throws InputError (naming the line) for anything that is not in
/// the grammar above: no selector or two, no action or two, a negative radius, min > max, a zero
/// axis, numbers that are not finite, a file of indices that cannot be read, or no entries.
std::vector<EditEntry> read_edit(const ConfigNode& list);

/// Puts the list of a YAML file whose only key is `edit` into the map `root`, under that key.
/// Throws InputError as load_config does, and for another key.
void put_edit(const std::filesystem::path& path, ConfigNode& root);

/// The handles and targets of an edit for one shape. Each vertex occurs once. Vertices are in the
/// order of the entries, and ascend within an entry. handles.rotations has the rotations that
/// entries with `rotate` ask for, and handles.groups the entry of each handle that moves.
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

/// Selects by rest positions. A vertex that several entries move to the same position counts once,
/// for the first of them, and turns as the first one says that says something about its rotation.
/// Throws InputError (naming the entries) if an index does not exist, a selection is empty, a
/// vertex is both fixed and moved or moved to two positions, a target is not finite, or there are
/// no entries.
ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings = {});

}  // namespace deformlab
