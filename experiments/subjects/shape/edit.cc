#include "experiments/subjects/shape/edit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <numbers>
#include <sstream>

#include "experiments/config/config.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

std::string text_of(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text << '[' << p.x() << ", " << p.y() << ", " << p.z() << ']';
  return text.str();
}

/// Reads an index a line; blank lines are skipped.
std::vector<int> read_indices(const std::filesystem::path& path, const std::string& where) {
  std::ifstream file(path);
  std::error_code ignored;
  if (!file || std::filesystem::is_directory(path, ignored)) {
    throw InputError(where + ": cannot read the vertex indices in " + quote(path.string()));
  }
  std::vector<int> indices;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    const char* end = text.data() + text.find_last_not_of(" \t\r") + 1;
    const auto [last, error] = std::from_chars(text.data() + begin, end, indices.emplace_back());
    if (error != std::errc() || last != end) {
      throw InputError("expected a vertex index (line " + std::to_string(line) + " of " +
                       path.string() + "), found " + quote(text));
    }
  }
  return indices;
}

void check_only_true(const std::optional<bool>& flag, const char* name, const std::string& where) {
  if (flag && !*flag) {
    throw InputError(where + ": '" + name + "' can only be true; leave it out otherwise");
  }
}

}  // namespace

void check_selection(const Selection& select, const std::string& where) {
  check_only_true(select.all, "all", where);
  const int given = select.vertices.has_value() + select.box.has_value() +
                    select.sphere.has_value() + select.nearest.has_value() +
                    select.point.has_value() + select.file.has_value() + select.all.has_value();
  if (given != 1) {
    throw InputError(where + ": 'select' needs exactly one of vertices, box, sphere, nearest, " +
                     "point, file, all; found " + std::to_string(given));
  }
  if (select.box && (select.box->min.array() > select.box->max.array()).any()) {
    throw InputError(where + ": the box's min " + text_of(select.box->min) +
                     " must not exceed its max " + text_of(select.box->max));
  }
}

namespace {

void check_action(const EditEntry& entry) {
  check_only_true(entry.fix, "fix", entry.where);
  const bool motion = entry.by.has_value() || entry.rotate.has_value();
  const int given = entry.fix.has_value() + entry.to.has_value() + motion;
  if (given != 1) {
    throw InputError(entry.where + ": needs exactly one of fix, by, to, rotate (or rotate and by)" +
                     (given == 0 ? "; found none" : "; found several"));
  }
  if (entry.rotate && entry.rotate->axis.stableNorm() == 0) {
    throw InputError(entry.where + ": the rotation's axis must not be [0, 0, 0]");
  }
}

/// The vertices whose rest position passes a test, in ascending order.
template <class Inside>
std::vector<int> select_if(const Eigen::Matrix3Xd& V, Inside&& inside) {
  std::vector<int> selected;
  for (int i = 0; i < V.cols(); ++i) {
    if (inside(V.col(i))) selected.push_back(i);
  }
  return selected;
}

std::vector<int> listed(std::vector<int> selected, const Shape& shape, const std::string& where) {
  const int count = static_cast<int>(shape.V.cols());
  for (const int i : selected) {
    if (i >= 0 && i < count) continue;
    throw InputError(where + ": vertex " + std::to_string(i) + " does not exist; the shape " +
                     "has " + std::to_string(count) + " vertices, counted from 0");
  }
  std::sort(selected.begin(), selected.end());
  selected.erase(std::unique(selected.begin(), selected.end()), selected.end());
  return selected;
}

/// The vertices selected, in ascending order, each once.
std::vector<int> select(const Selection& by, const Shape& shape, const std::string& where) {
  if (by.vertices) return listed(*by.vertices, shape, where);
  if (by.box) {
    return select_if(shape.V, [&](const auto& p) {
      return (p.array() >= by.box->min.array()).all() && (p.array() <= by.box->max.array()).all();
    });
  }
  if (by.sphere) {
    return select_if(shape.V, [&](const auto& p) {
      return (p - by.sphere->center).norm() <= by.sphere->radius;
    });
  }
  if (by.nearest) {
    Eigen::Index closest = 0;
    (shape.V.colwise() - *by.nearest).colwise().squaredNorm().minCoeff(&closest);
    return {static_cast<int>(closest)};
  }
  return select_if(shape.V, [&](const auto&) { return by.all.has_value(); });
}

}  // namespace

std::vector<int> select_vertices(const Selection& selection, const Shape& shape,
                                 const std::string& where) {
  if (selection.point) {
    throw InputError(where + ": 'point' is a place, not a vertex; take 'nearest' here");
  }
  std::vector<int> selected = select(selection, shape, where);
  if (!selected.empty()) return selected;
  throw InputError(where + " selects no vertex; the shape reaches from " +
                   text_of(shape.V.rowwise().minCoeff()) + " to " +
                   text_of(shape.V.rowwise().maxCoeff()) +
                   ": check the unit and the axes of the selection");
}

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

Eigen::Matrix3Xd matrix(const std::vector<Eigen::Vector3d>& columns) {
  Eigen::Matrix3Xd result(3, columns.size());
  for (std::size_t l = 0; l < columns.size(); ++l) result.col(l) = columns[l];
  return result;
}

/// Gathers the vertices of one entry after another and finds contradictions between them.
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
    handles_.points = matrix(points_);
    targets_.insert(targets_.end(), point_targets_.begin(), point_targets_.end());
    return {std::move(handles_), matrix(targets_)};
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
    for (std::size_t k = 0; k < selected.size(); ++k) {
      const bool exactly = entry.to && selected.size() == 1;  // free of rounding
      move(selected[k], e, exactly ? *entry.to : Eigen::Vector3d(motion * P.col(k)));
    }
    if (entry.rotate && selected.size() == 1) add_ring(P.col(0), motion, e);
  }

  void add_point(const Eigen::Vector3d& p, int e) {
    const EditEntry& entry = entries_[e];
    const Eigen::Isometry3d motion = motion_of(entry, p);
    const Eigen::Vector3d target = entry.fix ? p : entry.to ? *entry.to : motion * p;
    check_range(target, e, "the place " + text_of(p));
    points_.push_back(p);
    point_targets_.push_back(target);
    if (entry.rotate) add_ring(p, motion, e);
  }

  // Eight places about the axis, as far as they are inside.
  void add_ring(const Eigen::Vector3d& p, const Eigen::Isometry3d& motion, int e) {
    if (rings_.radius == 0) return;
    const Eigen::Vector3d axis = entries_[e].rotate->axis.stableNormalized();
    const Eigen::Vector3d arm = rings_.radius * axis.unitOrthogonal();
    const std::size_t before = points_.size();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d end = p + Eigen::AngleAxisd(i * std::numbers::pi / 4, axis) * arm;
      if (!rings_.inside(end)) continue;
      points_.push_back(end);
      point_targets_.push_back(motion * end);
    }
    if (points_.size() > before) return;
    std::ostringstream message;
    message << entries_[e].where << ": a rotation handle needs a place inside the shape "
            << rings_.radius << " from " << text_of(p) << ", and there is none; move it inwards";
    throw InputError(message.str());
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

  void move(int i, int e, const Eigen::Vector3d& target) {
    check_range(target, e, "vertex " + std::to_string(i));
    if (owner_[i] < 0) {
      owner_[i] = e;
      column_[i] = static_cast<int>(targets_.size());
      handles_.moved.push_back(i);
      targets_.push_back(target);
      return;
    }
    if (column_[i] < 0) throw_fixed_and_moved(i, owner_[i], e);
    const Eigen::Vector3d& first = targets_[column_[i]];
    if ((first - target).norm() <= same_) return;
    throw InputError("vertex " + std::to_string(i) + " is moved to " + text_of(first) + " by " +
                     entries_[owner_[i]].where + " and to " + text_of(target) + " by " +
                     entries_[e].where + "; keep one");
  }

  [[noreturn]] void throw_fixed_and_moved(int i, int fixing, int moving) const {
    throw InputError("vertex " + std::to_string(i) + " is fixed by " + entries_[fixing].where +
                     " and moved by " + entries_[moving].where +
                     "; take it out of one of the selections");
  }

  const std::vector<EditEntry>& entries_;
  const Shape& shape_;
  const Rings& rings_;
  const double same_;        ///< targets this close are one place: they differ by rounding
  std::vector<int> owner_;   ///< by vertex: the entry that took it first, or -1
  std::vector<int> column_;  ///< by vertex: its column of the targets, or -1
  Handles handles_;
  std::vector<Eigen::Vector3d> targets_, points_, point_targets_;
};

/// The whole of an edit file.
struct EditFile {
  ConfigNode edit;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("edit", o.edit, "Selections and what happens to them");
  }
};

}  // namespace

std::vector<EditEntry> read_edit(const ConfigNode& list) {
  check_list(list, "edit");
  std::vector<EditEntry> entries;
  read_value(list, "edit", entries);
  if (entries.empty()) throw InputError("'edit' has no entries (" + list.where() + ")");
  for (std::size_t e = 0; e < entries.size(); ++e) {
    EditEntry& entry = entries[e];
    const ConfigNode& node = list.children[e];
    entry.where = "edit entry " + std::to_string(e + 1) + " (" + node.where() + ")";
    check_selection(entry.select, entry.where);
    check_action(entry);
    if (!entry.select.file) continue;
    const ConfigNode& file = *node.find("select")->find("file");
    entry.select.vertices = read_indices(file.folder() / *entry.select.file, entry.where);
    entry.select.file.reset();
  }
  return entries;
}

std::vector<EditEntry> read_edit_file(const std::filesystem::path& path) {
  return read_edit(read_config<EditFile>(load_config(path)).edit);
}

ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Shape& shape,
                     const Rings& rings) {
  if (entries.empty()) throw InputError("the edit has no entries");
  if (shape.V.cols() == 0) throw InputError("the shape to edit has no vertices");
  return Resolver(entries, shape, rings).run();
}

}  // namespace deformlab
