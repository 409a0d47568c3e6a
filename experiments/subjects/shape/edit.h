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

/// The factor by which a selection grows: the same in all directions, or one along each axis.
struct ScaleFactor {
  Eigen::Vector3d value = Eigen::Vector3d::Ones();
};
void read_value(const ConfigNode& node, const std::string& name, ScaleFactor& value);
ConfigNode to_node(const ScaleFactor& value);

/// A selection grows or shrinks.
struct Scaling {
  ScaleFactor factor;
  std::optional<Eigen::Vector3d> center;  ///< by default the centroid of the selection
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("factor", o.factor, "A number above 0, or one for each axis [x, y, z]");
    visit("center", o.center,
          "The point that stays, by default the centroid of the selection [length]");
  }
};
/// An affine map of [x, y, z, 1]. Its last row is 0, 0, 0, 1.
struct AffineMatrix {
  Eigen::Matrix4d value = Eigen::Matrix4d::Identity();
};
void read_value(const ConfigNode& node, const std::string& name, AffineMatrix& value);
ConfigNode to_node(const AffineMatrix& value);

/// Where one handle goes, as a file of targets says.
struct ListedTarget {
  int vertex = -1;                ///< −1: it is a point
  Eigen::Vector3d place, target;  ///< [length]; the place is that of a point at rest
  int line = 0;                   ///< of the file, from 1
};

/// One entry of an edit: a selection and what happens to it. Exactly one of fix, to, matrix,
/// targets is given, or any of scale, rotate and by, which happen in this order. `targets` selects
/// by itself, all others have a `select`.
struct EditEntry {
  std::optional<Selection> selection;
  std::optional<bool> fix;            ///< only ever true
  std::optional<Eigen::Vector3d> by;  ///< translation [length]
  /// Where the selection goes [length]. One vertex goes to this point. Several are translated
  /// together, so that their centroid is there.
  std::optional<Eigen::Vector3d> to;
  std::optional<Turn> rotate;
  std::optional<Scaling> scale;
  std::optional<AffineMatrix> matrix;
  std::optional<std::filesystem::path> targets;
  double weight = 1;
  std::vector<ListedTarget> listed;  ///< the content of `targets`
  std::string where;                 ///< "edit entry 2 (line 5 of edit.yaml)", for messages
  int dimension = 3;                 ///< 2 in a drawing
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("select", o.selection, "The vertices, by exactly one of the following");
    visit("fix", o.fix, "true fixes the vertices at their positions");
    visit("by", o.by, "A translation [dx, dy, dz] [length]");
    visit("to", o.to,
          "The position [x, y, z] to which the vertex, or the centroid of the selection, goes "
          "[length]");
    visit(
        "rotate", o.rotate,
        "A rotation; together with 'by' it comes first. One vertex, or one point, holds the angle");
    visit("scale", o.scale, "A change of size; together with 'rotate' and 'by' it comes first");
    visit("matrix", o.matrix,
          "A 4×4 matrix, as a list of its four rows, that takes a position and 1 to the target and "
          "1");
    visit(
        "targets", o.targets,
        "A CSV file beside the YAML file, with one handle in each line: the index of a vertex, or "
        "a place x,y,z, and then its target x,y,z. It replaces 'select'");
    visit.range("weight", o.weight, {.min = 0, .exclusive_min = true},
                "The weight of each of these handles in E_con; the others have 1");
  }
};

/// Reads the list under `edit:`. Throws InputError (naming the line) for anything that is not in
/// the grammar above: no selector or two, no action or two, a negative radius, min > max, a zero
/// axis, a factor that is not above 0, numbers that are not finite, a file of indices or targets
/// that cannot be read, or no entries. With 2 dimensions, a file of targets has no z.
std::vector<EditEntry> read_edit(const ConfigNode& list, int dimension = 3);

/// Puts the list of a YAML file whose only key is `edit` into the map `root`, under that key.
/// Throws InputError as load_config does, and for another key.
void put_edit(const std::filesystem::path& path, ConfigNode& root);

/// How a selection moves: p goes to center + R S (p − center) + shift.
struct Motion {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [length]
  /// The rotation vector of R, the unit axis times the angle as it was asked for [radian]. NaN if
  /// nothing is said about a rotation: the selection is one point or lies on a line, and is moved.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();  ///< S, symmetric
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();        ///< [length]

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;
};

/// The handles and targets of an edit for one shape. Each vertex occurs once. Vertices are in the
/// order of the entries, and ascend within an entry. handles.rotations has the rotations that
/// entries with `rotate` ask for, and handles.groups the entry of each handle that moves.
struct ResolvedEdit {
  Handles handles;
  Eigen::Matrix3Xd targets;       ///< 3×#, of handles.moved and then of handles.points [length]
  std::vector<Motion> motions{};  ///< of each of handles.groups
  /// What a user should know, one sentence each.
  std::vector<std::string> notes{};

  /// The targets when a share of the way is done (0 to 1). `rest` is 3×#, the handles at rest
  /// [length]. What rotates goes along arcs, and everything else straight.
  Eigen::Matrix3Xd targets_at(double share, const Eigen::Matrix3Xd& rest) const;
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
/// vertex is both fixed and moved or moved to two positions, a point is farther from the shape than
/// the shape is large, a target is not finite, or there are no entries.
ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings = {});

}  // namespace deformlab
