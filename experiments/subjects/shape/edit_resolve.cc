#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "experiments/subjects/shape/edit.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

/// The motion that the entry's action gives to its vertices, whose rest positions are P (3×#).
Eigen::Isometry3d motion_of(const EditEntry& entry, const Eigen::Matrix3Xd& P) {
  const Eigen::Vector3d centroid = P.rowwise().mean();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (entry.to) motion.translation() = *entry.to - centroid;
  if (entry.rotate) {
    const Eigen::Vector3d center = entry.rotate->center.value_or(centroid);
    const double angle = entry.rotate->degrees * std::numbers::pi / 180;
    motion.translate(center);
    motion.rotate(Eigen::AngleAxisd(angle, entry.rotate->axis.stableNormalized()));
    motion.translate(-center);
  }
  if (entry.by) motion.pretranslate(*entry.by);
  return motion;
}

/// The rotation vector [radian] that the entry asks for. Where it has no rotation, one handle may
/// turn as it likes, which NaN says, and several are translated.
Eigen::Vector3d turn_of(const EditEntry& entry, std::size_t selected) {
  if (entry.rotate) {
    return entry.rotate->degrees * std::numbers::pi / 180 * entry.rotate->axis.stableNormalized();
  }
  return Eigen::Vector3d::Constant(selected == 1 ? std::numeric_limits<double>::quiet_NaN() : 0);
}

/// Where a handle goes, how it turns on the way there, and the entry that says so.
struct Target {
  Eigen::Vector3d position, turn;
  int entry;
};

/// A matrix of one column of each item.
template <class Item, class Column>
Eigen::Matrix3Xd matrix(const std::vector<Item>& items, Column&& column) {
  Eigen::Matrix3Xd result(3, items.size());
  for (std::size_t l = 0; l < items.size(); ++l) result.col(l) = std::invoke(column, items[l]);
  return result;
}

/// Collects the vertices of the entries, and finds contradictions between entries.
class Resolver {
 public:
  Resolver(const std::vector<EditEntry>& entries, const Shape& shape, const Rings& rings)
      : entries_(entries),
        shape_(shape),
        rings_(rings),
        same_(1e-9 * bounding_box_diagonal(shape.V)),
        owner_(static_cast<std::size_t>(shape.V.cols()), -1),
        column_(owner_.size(), -1) {}

  ResolvedEdit run() {
    for (std::size_t e = 0; e < entries_.size(); ++e) add(static_cast<int>(e));
    handles_.points = matrix(points_, std::identity());
    targets_.insert(targets_.end(), point_targets_.begin(), point_targets_.end());
    add_motions();
    return {std::move(handles_), matrix(targets_, &Target::position)};
  }

 private:
  void add(int e) {
    const EditEntry& entry = entries_[e];
    if (entry.select.point) {
      add_point(*entry.select.point, e);
      return;
    }
    const std::vector<int> selected = select_vertices(entry.select, shape_, entry.where);
    if (entry.fix) {
      for (const int i : selected) fix(i, e);
      return;
    }
    const Eigen::Matrix3Xd P = shape_.V(Eigen::all, selected);
    const Eigen::Isometry3d motion = motion_of(entry, P);
    const Eigen::Vector3d turn = turn_of(entry, selected.size());
    for (std::size_t k = 0; k < selected.size(); ++k) {
      const bool exactly = entry.to && selected.size() == 1;  // avoids rounding errors
      move(selected[k], {exactly ? *entry.to : Eigen::Vector3d(motion * P.col(k)), turn, e});
    }
    if (entry.rotate && selected.size() == 1) add_ring(P.col(0), motion, e);
  }

  void add_point(const Eigen::Vector3d& p, int e) {
    const EditEntry& entry = entries_[e];
    const Eigen::Isometry3d motion = motion_of(entry, p);
    const Eigen::Vector3d target = entry.fix ? p : entry.to ? *entry.to : motion * p;
    check_range(target, e, "the point " + text_of(p));
    points_.push_back(p);
    point_targets_.push_back({target, turn_of(entry, 1), e});
    if (entry.rotate) add_ring(p, motion, e);
  }

  // Adds eight points about the axis, if they are inside the shape.
  void add_ring(const Eigen::Vector3d& p, const Eigen::Isometry3d& motion, int e) {
    if (rings_.radius == 0) return;
    const Eigen::Vector3d axis = entries_[e].rotate->axis.stableNormalized();
    const Eigen::Vector3d arm = rings_.radius * axis.unitOrthogonal();
    const std::size_t before = points_.size();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d end = p + Eigen::AngleAxisd(i * std::numbers::pi / 4, axis) * arm;
      if (!rings_.inside(end)) continue;
      points_.push_back(end);
      point_targets_.push_back({motion * end, turn_of(entries_[e], 1), e});
    }
    if (points_.size() > before) return;
    throw InputError(fmt::format(
        "{}: a rotation handle needs a point inside the shape {:.6g} from {}, and there is none; "
        "move it inwards",
        entries_[e].where, rings_.radius, text_of(p)));
  }

  void fix(int i, int e) {
    if (column_[i] >= 0) throw_fixed_and_moved(i, e, owner_[i]);
    if (owner_[i] >= 0) return;
    owner_[i] = e;
    handles_.fixed.push_back(i);
  }

  void check_range(const Eigen::Vector3d& target, int e, const std::string& what) const {
    if (target.cwiseAbs().maxCoeff() <= kMostLength) return;
    throw InputError(entries_[e].where + " moves " + what + " beyond the range of numbers, to " +
                     text_of(target));
  }

  void move(int i, const Target& target) {
    const int e = target.entry;
    check_range(target.position, e, "vertex " + std::to_string(i));
    if (owner_[i] < 0) {
      owner_[i] = e;
      column_[i] = static_cast<int>(targets_.size());
      handles_.moved.push_back(i);
      targets_.push_back(target);
      return;
    }
    if (column_[i] < 0) throw_fixed_and_moved(i, owner_[i], e);
    Target& first = targets_[column_[i]];
    if ((first.position - target.position).norm() <= same_) {
      if (first.turn.hasNaN()) first.turn = target.turn;
      return;
    }
    throw InputError(fmt::format("vertex {} is moved to {} by {} and to {} by {}; keep one", i,
                                 text_of(first.position), entries_[owner_[i]].where,
                                 text_of(target.position), entries_[e].where));
  }

  void add_motions() {
    const auto rotates = [&](const Target& target) {
      return entries_[target.entry].rotate.has_value();
    };
    if (std::ranges::any_of(targets_, rotates))
      handles_.rotations = matrix(targets_, &Target::turn);
    for (const Target& target : targets_) handles_.groups.push_back(target.entry);
  }

  [[noreturn]] void throw_fixed_and_moved(int i, int fixing, int moving) const {
    throw InputError(fmt::format(
        "vertex {} is fixed by {} and moved by {}; take it out of one of the selections", i,
        entries_[fixing].where, entries_[moving].where));
  }

  const std::vector<EditEntry>& entries_;
  const Shape& shape_;
  const Rings& rings_;
  const double same_;        ///< targets that are this close differ only by rounding errors
  std::vector<int> owner_;   ///< by vertex: the entry that took it first, or -1
  std::vector<int> column_;  ///< by vertex: its column of the targets, or -1
  Handles handles_;
  std::vector<Target> targets_, point_targets_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace

ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings) {
  if (entries.empty()) throw InputError("the edit has no entries");
  if (shape.V.cols() == 0) throw InputError("the shape to edit has no vertices");
  return Resolver(entries, shape, rings).run();
}

}  // namespace deformlab
