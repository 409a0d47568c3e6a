#include "experiments/subjects/drawing/plane_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/subjects/drawing/plane_edit.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr FrameNumber kMostFrames = 100'000, kLastFrame = 1'000'000'000;

// The moment of a keyframe, as the file gives it.
std::string moment_text(const KeyframeOptions& o) {
  return o.frame ? fmt::format("frame {}", *o.frame) : fmt::format("time {:g}", o.time.value_or(0));
}

void check_order(const KeyframesOptions& options) {
  const auto moment = [&](const KeyframeOptions& o) {
    return o.frame ? static_cast<FrameTime>(*o.frame)
                   : static_cast<FrameTime>(o.time.value_or(0)) * options.fps;
  };
  for (std::size_t i = 1; i < options.keyframes.size(); ++i) {
    const KeyframeOptions &before = options.keyframes[i - 1], &here = options.keyframes[i];
    if (moment(here) > moment(before)) continue;
    throw InputError(fmt::format(
        "keyframe {} ({}) is of {}, and keyframe {} before it is of {}; keyframes stand in the "
        "order of time, each at a moment of its own",
        i + 1, here.edit.key_where(), moment_text(here), i, moment_text(before)));
  }
}

void check_options_of_meshes(const AnimationOptions& o) {
  if (o.keyframes.pose) {
    throw InputError("'pose' is for meshes: a drawing has one shape at rest; leave it out");
  }
  if (o.path) throw InputError("'path' is the id of a particle; a drawing has none");
  if (o.generator == AnimationGenerator::kNone && o.file.empty()) return;
  throw InputError(
      "a config is about a drawing (drawing.file) or an animation of a mesh or of particles "
      "(animation.file, animation.generator); keep one of them");
}

TimedEdit always(const ConfigNode& edit) {
  return {{}, read_plane_edit(edit), "edit (" + edit.key_where() + ")"};
}

Script keyframed(const ConfigNode& edit, const KeyframesOptions& options) {
  Script script = read_script(edit, options, read_plane_edit);
  check_order(options);
  if (options.keyframes.size() >= 2) return script;
  throw InputError(fmt::format(
      "an animation of a drawing goes from one keyframe to the next, so that 'keyframes' needs two "
      "or more entries, and it has {}",
      options.keyframes.size()));
}

void check_apart(const Eigen::Matrix2Xd& points, const std::vector<TimedEdit>& poses) {
  constexpr double kSame = 1e-6;  // of the extent of all
  const double extent = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if ((points.col(i) - points.col(j)).norm() > kSame * extent) continue;
      throw InputError(fmt::format("{} and {} are both at ({:g}, {:g}); one point has one pose",
                                   poses[static_cast<std::size_t>(j)].where,
                                   poses[static_cast<std::size_t>(i)].where, points(0, i),
                                   points(1, i)));
    }
  }
}

SpatialScript read_poses(const KeyframesOptions& options, std::vector<TimedEdit>& poses) {
  const PerformanceOptions& o = options.performed;
  if (o.poses.size() < 2) {
    throw InputError(fmt::format(
        "a cursor blends key poses, so that 'poses' needs two or more entries, and it has {}",
        o.poses.size()));
  }
  if (!o.has_cursor()) {
    throw InputError(
        "'poses' are blended by a cursor: add 'cursor: FILE.csv', a table of time,x,y");
  }
  SpatialScript spatial{Eigen::Matrix2Xd(2, std::ssize(o.poses)), {}};
  for (std::size_t i = 0; i < o.poses.size(); ++i) {
    const ConfigNode& edit = o.poses[i].edit;
    const std::string where = fmt::format("pose {} ({})", i + 1, edit.key_where());
    spatial.points.col(static_cast<Eigen::Index>(i)) = point_of(o.poses[i].at, where);
    poses.push_back({static_cast<FrameTime>(i), read_plane_edit(edit), where});
  }
  check_apart(spatial.points, poses);
  spatial.cursor = read_cursor(o.cursor, options.fps);
  return spatial;
}

EditEntry entry_of(const PerformedHandle& row) {
  EditEntry entry;
  entry.selection.emplace();
  entry.selection->point = Eigen::Vector3d(row.place.x(), row.place.y(), 0);
  entry.selection->dimension = entry.dimension = 2;
  entry.to = Eigen::Vector3d(row.target.x(), row.target.y(), 0);
  if (row.turns) entry.rotate.emplace().degrees = row.degrees;
  entry.where = row.where;
  return entry;
}

std::vector<TimedEdit> performed(const KeyframesOptions& options) {
  if (!options.performed.has_performance() || options.performed.handles.empty()) {
    throw InputError(
        "'handles' names the handles that the CSV file 'performance' moves: give both of them");
  }
  std::vector<TimedEdit> edits;
  for (const PerformedHandle& row : read_performance(options.performed, options.fps)) {
    const bool goes_on = !edits.empty() && edits.back().frame == row.moment;
    if (!goes_on) edits.push_back({row.moment, {}, row.where});
    edits.back().entries.push_back(entry_of(row));
  }
  return edits;
}

struct Moment {
  FrameTime at;
  std::string where;
};

FrameRange range_between(const Moment& first, const Moment& last) {
  if (first.at < 0) {
    throw InputError(fmt::format("{} is of frame {}; the frames of a drawing are counted from 0",
                                 first.where, text_of(first.at)));
  }
  if (last.at > kLastFrame) {
    throw InputError(fmt::format("{} is of frame {}; a frame's number is at most {}", last.where,
                                 text_of(last.at), kLastFrame));
  }
  if (last.at - first.at > kMostFrames) {
    throw InputError(fmt::format("{} is of frame {}, which is more than {} frames after {}",
                                 last.where, text_of(last.at), kMostFrames, first.where));
  }
  const FrameRange range{static_cast<FrameNumber>(std::ceil(first.at)),
                         static_cast<FrameNumber>(std::floor(last.at))};
  if (range.first <= range.last) return range;
  throw InputError(fmt::format(
      "no frame lies between {} and {}, which are of frames {} and {}; raise 'fps' or move one of "
      "them",
      first.where, last.where, text_of(first.at), text_of(last.at)));
}

FrameRange range_of(const PlaneScript& plane) {
  if (plane.spatial) {
    const CursorPath& c = plane.spatial->cursor;
    return range_between({c.moments.front(), c.where.front()}, {c.moments.back(), c.where.back()});
  }
  const std::vector<TimedEdit>& edits = plane.script.edits;
  const auto first =
      std::ranges::find_if(edits, [](const TimedEdit& timed) { return timed.frame.has_value(); });
  return range_between({*first->frame, first->where}, {*edits.back().frame, edits.back().where});
}

void check_one_way(const KeyframesOptions& o) {
  const PerformanceOptions& p = o.performed;
  const bool poses = !p.poses.empty() || p.has_cursor();
  const bool performance = !p.handles.empty() || p.has_performance();
  const int ways = static_cast<int>(!o.keyframes.empty()) + poses + performance;
  if (ways <= 1) return;
  throw InputError(
      "a drawing moves by 'keyframes', by 'poses' and a 'cursor', or by 'handles' and a "
      "'performance'; keep one of the three");
}

}  // namespace

PlaneScript read_plane_script(const ConfigNode& edit, const AnimationOptions& options) {
  const KeyframesOptions& keys = options.keyframes;
  check_options_of_meshes(options);
  check_one_way(keys);
  PlaneScript plane;
  if (!keys.performed.given()) {
    plane.script = keyframed(edit, keys);
  } else {
    plane.script.interpolation = keys.interpolation;
    std::vector<TimedEdit> moving;
    if (!keys.performed.poses.empty() || keys.performed.has_cursor()) {
      plane.spatial = read_poses(keys, moving);
    } else {
      moving = performed(keys);
    }
    if (edit.kind != ConfigNode::Kind::kNull) plane.script.edits.push_back(always(edit));
    std::ranges::move(moving, std::back_inserter(plane.script.edits));
  }
  std::vector<std::vector<EditEntry>*> lists;
  for (TimedEdit& timed : plane.script.edits) lists.push_back(&timed.entries);
  complete_angles(lists);
  plane.range = range_of(plane);
  return plane;
}

std::vector<EditEntry> all_entries(const Script& script) {
  std::vector<EditEntry> entries;
  for (const TimedEdit& timed : script.edits) {
    entries.insert(entries.end(), timed.entries.begin(), timed.entries.end());
  }
  return entries;
}

}  // namespace deformlab
