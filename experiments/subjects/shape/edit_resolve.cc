#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <numbers>

#include "experiments/subjects/shape/edit_motion.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

/// Where a handle goes, and the group and the entry that say so.
struct Target {
  Eigen::Vector3d position;
  int group, entry;
  int line = 0;  ///< of the file of targets that the entry names, or 0
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
        column_(owner_.size(), -1),
        motions_(entries.size()) {}

  ResolvedEdit run() {
    for (std::size_t e = 0; e < entries_.size(); ++e) add(static_cast<int>(e));
    handles_.points = matrix(points_, std::identity());
    targets_.insert(targets_.end(), point_targets_.begin(), point_targets_.end());
    add_motions();
    ResolvedEdit edit{std::move(handles_), matrix(targets_, &Target::position),
                      std::move(motions_)};
    edit.notes = std::move(notes_);
    return edit;
  }

 private:
  void add(int e) {
    const EditEntry& entry = entries_[e];
    if (entry.targets) {
      add_listed(e);
      return;
    }
    if (entry.selection->point) {
      add_point(*entry.selection->point, e);
      return;
    }
    const std::vector<int> selected = select_vertices(*entry.selection, shape_, entry.where);
    if (entry.fix) {
      for (const int i : selected) fix(i, e);
      return;
    }
    const Eigen::Matrix3Xd P = shape_.V(Eigen::all, selected);
    motions_[e] = motion_of(entry, P);
    if (entry.matrix) note_matrix(entry);
    for (std::size_t k = 0; k < selected.size(); ++k) {
      const bool exactly = entry.to && selected.size() == 1;  // avoids rounding errors
      move(selected[k], {exactly ? *entry.to : motions_[e](P.col(k)), e, e});
    }
    if (entry.rotate && selected.size() == 1) add_ring(P.col(0), e);
  }

  void add_point(const Eigen::Vector3d& p, int e) {
    const EditEntry& entry = entries_[e];
    motions_[e] = motion_of(entry, p);
    put_point(p, {entry.fix ? p : entry.to ? *entry.to : motions_[e](p), e, e});
    if (entry.rotate) add_ring(p, e);
  }

  // Nothing says that these handles move together but where they go: each is a group, unless all
  // take part in one rigid motion.
  void add_listed(int e) {
    const std::vector<ListedTarget>& listed = entries_[e].listed;
    const int first_group = static_cast<int>(motions_.size());
    const auto target_of = [&](const ListedTarget& l, int group) {
      return Target{l.target, group, e, l.line};
    };
    for (const ListedTarget& l : listed) {
      if (l.vertex >= 0) check_exists(l.vertex, shape_, where(target_of(l, 0)));
    }
    const auto rest_of = [&](const ListedTarget& l) {
      return l.vertex < 0 ? l.place : shape_.V.col(l.vertex).eval();
    };
    const bool as_one =
        is_rigid_motion(matrix(listed, rest_of), matrix(listed, &ListedTarget::target));
    for (const ListedTarget& l : listed) {
      EditEntry entry;
      entry.to = l.target;
      motions_.push_back(motion_of(entry, rest_of(l)));
      const int group = as_one ? first_group : static_cast<int>(motions_.size()) - 1;
      if (l.vertex < 0) {
        put_point(l.place, target_of(l, group));
      } else {
        move(l.vertex, target_of(l, group));
      }
    }
  }

  /// A position as a message about entry e gives it.
  std::string text(const Eigen::Vector3d& p, int e) const {
    return text_of(p, entries_[e].dimension);
  }

  // A region that is mirrored or flattened is turned inside out, and so it cannot look right.
  void note_matrix(const EditEntry& entry) {
    const double det = entry.matrix->value.topLeftCorner<3, 3>().determinant();
    if (det > 0) return;
    notes_.push_back(
        fmt::format("{}: the determinant of 'matrix' is {:.3g}, so that it {} the selection; the "
                    "shape can only "
                    "follow it by turning inside out or tearing",
                    entry.where, det, det < 0 ? "mirrors" : "flattens"));
  }

  std::string where(const Target& target) const {
    const EditEntry& entry = entries_[target.entry];
    if (target.line == 0) return entry.where;
    return fmt::format("{}, line {} of {}", entry.where, target.line, entry.targets->string());
  }

  void put_point(const Eigen::Vector3d& p, const Target& target) {
    check_range(target, fmt::format("the point {}", text(p, target.entry)));
    check_near(p, target);
    points_.push_back(p);
    point_targets_.push_back(target);
  }

  // Adds eight points about the axis, if they are inside the shape.
  void add_ring(const Eigen::Vector3d& p, int e) {
    if (rings_.radius == 0) return;
    const Eigen::Vector3d axis = entries_[e].rotate->axis.stableNormalized();
    const Eigen::Vector3d arm = rings_.radius * axis.unitOrthogonal();
    const std::size_t before = points_.size();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d end = p + Eigen::AngleAxisd(i * std::numbers::pi / 4, axis) * arm;
      if (!rings_.inside(end)) continue;
      points_.push_back(end);
      point_targets_.push_back({motions_[e](end), e, e});
    }
    if (points_.size() > before) return;
    throw InputError(fmt::format(
        "{}: a rotation handle needs a point inside the shape {:.6g} from {}, and there is none; "
        "move it inwards",
        entries_[e].where, rings_.radius, text(p, e)));
  }

  void fix(int i, int e) {
    if (column_[i] >= 0) throw_fixed_and_moved(i, e, owner_[i]);
    if (owner_[i] >= 0) return;
    owner_[i] = e;
    handles_.fixed.push_back(i);
  }

  void check_range(const Target& target, const std::string& what) const {
    if (target.position.cwiseAbs().maxCoeff() <= kMostLength) return;
    throw InputError(fmt::format("{} moves {} beyond the range of numbers, to {}", where(target),
                                 what, text(target.position, target.entry)));
  }

  // Such a point has another unit or other axes than the shape.
  void check_near(const Eigen::Vector3d& p, const Target& target) const {
    const Eigen::Vector3d low = shape_.V.rowwise().minCoeff(), high = shape_.V.rowwise().maxCoeff();
    const double size = (high - low).norm(), away = (p - p.cwiseMax(low).cwiseMin(high)).norm();
    if (away <= size || size == 0) return;
    throw InputError(
        fmt::format("{}: the point {} is {:.3g} away from the shape, which reaches from {} to {}: "
                    "check the unit "
                    "and the axes",
                    where(target), text(p, target.entry), away, text(low, target.entry),
                    text(high, target.entry)));
  }

  void move(int i, const Target& target) {
    const int e = target.entry;
    check_range(target, "vertex " + std::to_string(i));
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
      if (turn_of(first).hasNaN()) first.group = target.group;
      return;
    }
    throw InputError(fmt::format("vertex {} is moved to {} by {} and to {} by {}; keep one", i,
                                 text(first.position, target.entry), where(first),
                                 text(target.position, target.entry), where(target)));
  }

  const Eigen::Vector3d& turn_of(const Target& target) const { return motions_[target.group].turn; }

  void add_motions() {
    const auto any = [&](auto&& has) {
      return std::ranges::any_of(targets_, [&](const Target& t) { return has(entries_[t.entry]); });
    };
    if (any([](const EditEntry& entry) { return entry.rotate || entry.matrix; })) {
      handles_.rotations = matrix(targets_, [&](const Target& target) { return turn_of(target); });
    }
    for (const Target& target : targets_) handles_.groups.push_back(target.group);
    if (!any([](const EditEntry& entry) { return entry.weight != 1; })) return;
    handles_.weights.resize(std::ssize(targets_));
    for (Eigen::Index l = 0; l < handles_.weights.size(); ++l) {
      handles_.weights[l] = entries_[targets_[l].entry].weight;
    }
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
  std::vector<Motion> motions_;  ///< by group: one for each entry, then one for each listed target
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::string> notes_;
};

}  // namespace

Eigen::Matrix3Xd ResolvedEdit::targets_at(double share, const Eigen::Matrix3Xd& rest) const {
  Eigen::Matrix3Xd result = (1 - share) * rest + share * targets;
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    const Motion& motion = motions[handles.groups[l]];
    if (is_translation(motion)) continue;
    const Pose from{rest.col(l), Eigen::Vector3d::Zero(), {}};
    const Pose to{rest.col(l), targets.col(l) - rest.col(l), motion};
    result.col(l) = rest.col(l) + offset_between(from, to, share);
  }
  return result;
}

ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings) {
  if (entries.empty()) throw InputError("the edit has no entries");
  if (shape.V.cols() == 0) throw InputError("the shape to edit has no vertices");
  return Resolver(entries, shape, rings).run();
}

}  // namespace deformlab
