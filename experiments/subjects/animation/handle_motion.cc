#include "experiments/subjects/animation/handle_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "experiments/measure/drag.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_frame(int frame, const FrameRange& range, const std::string& what) {
  if (frame >= range.first && frame <= range.last) return;
  throw InputError(fmt::format("{} names frame {}; the frames are {} to {}", what, frame,
                               range.first, range.last));
}

[[noreturn]] void throw_fixed_and_moved(int vertex, const std::string& fixing,
                                        const std::string& moving) {
  throw InputError(
      fmt::format("vertex {} is fixed by {} and moved by {}; a vertex that is fixed is "
                  "fixed in all frames",
                  vertex, fixing, moving));
}

double ease(double share) { return share * share * (3 - 2 * share); }

}  // namespace

HandleMotion::HandleMotion(const Script& script, const FrameRange& range,
                           const std::function<Shape(int)>& pose_of)
    : smooth_(script.smooth) {
  if (script.pose) check_frame(*script.pose, range, "'pose'");
  for (const TimedEdit& edit : script.edits) {
    if (edit.frame) check_frame(*edit.frame, range, edit.where);
  }
  for (const TimedEdit& edit : script.edits) {
    add(edit, pose_of(script.pose.value_or(edit.frame.value_or(range.first))));
  }
  collect();
}

void HandleMotion::add(const TimedEdit& edit, const Shape& pose) {
  const ResolvedEdit resolved = resolve(edit.entries, pose);
  const Handles& handles = resolved.handles;
  const Eigen::Matrix3Xd offsets = resolved.targets - targets_at_rest(pose, handles);
  for (const int i : handles.fixed) fix(i, edit);
  const auto moved = std::ssize(handles.moved);
  for (Eigen::Index l = 0; l < moved; ++l) {
    const int i = handles.moved[static_cast<std::size_t>(l)];
    const std::string what = "vertex " + std::to_string(i);
    if (const auto fixed = fixed_.find(i); fixed != fixed_.end()) {
      throw_fixed_and_moved(i, fixed->second, edit.where);
    }
    add_key(vertices_[i], edit, offsets.col(l), what);
  }
  for (Eigen::Index l = 0; l < handles.points.cols(); ++l) {
    const Eigen::Vector3d p = handles.points.col(l);
    add_key(points_[{p.x(), p.y(), p.z()}], edit, offsets.col(moved + l), "a point");
  }
}

void HandleMotion::fix(int vertex, const TimedEdit& edit) {
  fixed_.emplace(vertex, edit.where);
  const auto moved = vertices_.find(vertex);
  if (moved == vertices_.end()) return;
  throw_fixed_and_moved(vertex, edit.where, moved->second.where);
}

void HandleMotion::add_key(Channel& channel, const TimedEdit& edit, const Eigen::Vector3d& offset,
                           const std::string& what) {
  if (channel.keys.empty()) {
    channel.where = edit.where;
    channel.always = !edit.frame;
  } else if (channel.always) {
    throw InputError(fmt::format("{} is moved by {}, which is of all frames, and by {}; keep one",
                                 what, channel.where, edit.where));
  }
  channel.keys.push_back({edit.frame.value_or(0), offset});
}

void HandleMotion::collect() {
  for (const auto& [vertex, edit] : fixed_) handles_.fixed.push_back(vertex);
  for (const auto& [vertex, channel] : vertices_) handles_.moved.push_back(vertex);
  handles_.points.resize(3, std::ssize(points_));
  Eigen::Index l = 0;
  for (const auto& [place, channel] : points_) {
    handles_.points.col(l++) << place[0], place[1], place[2];
  }
}

Eigen::Vector3d HandleMotion::offset(const Channel& channel, double frame) const {
  const auto after = std::find_if(channel.keys.begin(), channel.keys.end(),
                                  [&](const Key& key) { return key.frame > frame; });
  if (after == channel.keys.begin()) return after->offset;
  const Key& before = *std::prev(after);
  if (after == channel.keys.end()) return before.offset;
  const double share = (frame - before.frame) / (after->frame - before.frame);
  return before.offset + (smooth_ ? ease(share) : share) * (after->offset - before.offset);
}

Eigen::Matrix3Xd HandleMotion::offsets(double frame) const {
  Eigen::Matrix3Xd result(3, handles_.targets());
  Eigen::Index l = 0;
  for (const auto& [vertex, channel] : vertices_) result.col(l++) = offset(channel, frame);
  for (const auto& [place, channel] : points_) result.col(l++) = offset(channel, frame);
  return result;
}

std::string HandleMotion::description() const {
  std::ostringstream text;
  text << std::hexfloat << (smooth_ ? "smooth" : "linear");
  for (const int i : handles_.fixed) text << " fix " << i;
  const auto describe = [&](const Channel& channel) {
    for (const Key& key : channel.keys) text << ' ' << key.frame << ' ' << key.offset.transpose();
  };
  for (const auto& [vertex, channel] : vertices_) describe((text << " move " << vertex, channel));
  for (const auto& [place, channel] : points_) {
    text << " at " << place[0] << ' ' << place[1] << ' ' << place[2];
    describe(channel);
  }
  return text.str();
}

}  // namespace deformlab
