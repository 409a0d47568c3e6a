#include "experiments/subjects/animation/handle_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "experiments/measure/drag.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_frame(FrameNumber frame, const FrameRange& range, const std::string& what) {
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
                           const std::function<Shape(FrameNumber)>& pose_of)
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
  const Eigen::Matrix3Xd rest = targets_at_rest(pose, handles);
  const auto key = [&](Eigen::Index l) {
    const int group = handles.groups[static_cast<std::size_t>(l)];
    const double weight = handles.weights.size() == 0 ? 1 : handles.weights[l];
    const Eigen::Vector3d offset = resolved.targets.col(l) - rest.col(l);
    return Key{edit.frame.value_or(0),
               {rest.col(l), offset, resolved.motions[static_cast<std::size_t>(group)]},
               groups_ + group,
               weight};
  };
  for (const int i : handles.fixed) fix(i, edit);
  const auto moved = std::ssize(handles.moved);
  for (Eigen::Index l = 0; l < moved; ++l) {
    const int i = handles.moved[static_cast<std::size_t>(l)];
    const std::string what = "vertex " + std::to_string(i);
    if (const auto fixed = fixed_.find(i); fixed != fixed_.end()) {
      throw_fixed_and_moved(i, fixed->second, edit.where);
    }
    add_key(vertices_[i], edit, key(l), what);
  }
  for (Eigen::Index l = 0; l < handles.points.cols(); ++l) {
    const Eigen::Vector3d p = handles.points.col(l);
    add_key(points_[{p.x(), p.y(), p.z()}], edit, key(moved + l), "a point");
  }
  turns_ = turns_ || handles.rotations.cols() > 0;
  groups_ += static_cast<int>(resolved.motions.size());
}

void HandleMotion::fix(int vertex, const TimedEdit& edit) {
  fixed_.emplace(vertex, edit.where);
  const auto moved = vertices_.find(vertex);
  if (moved == vertices_.end()) return;
  throw_fixed_and_moved(vertex, edit.where, moved->second.where);
}

void HandleMotion::add_key(Channel& channel, const TimedEdit& edit, const Key& key,
                           const std::string& what) {
  if (channel.keys.empty()) {
    channel.where = edit.where;
    channel.always = !edit.frame;
  } else if (channel.always) {
    throw InputError(fmt::format("{} is moved by {}, which is of all frames, and by {}; keep one",
                                 what, channel.where, edit.where));
  }
  channel.keys.push_back(key);
}

void HandleMotion::collect() {
  for (const auto& [vertex, edit] : fixed_) handles_.fixed.push_back(vertex);
  for (const auto& [vertex, channel] : vertices_) handles_.moved.push_back(vertex);
  handles_.points.resize(3, std::ssize(points_));
  Eigen::Index l = 0;
  for (const auto& [place, channel] : points_) {
    handles_.points.col(l++) << place[0], place[1], place[2];
  }
  std::map<std::vector<int>, int> numbers;  // of groups, by their groups in the edits
  std::vector<double> weights;
  columns([&](const Channel& channel) {
    std::vector<int> groups;
    for (const Key& key : channel.keys) groups.push_back(key.group);
    handles_.groups.push_back(numbers.emplace(groups, std::ssize(numbers)).first->second);
    weights.push_back(channel.keys.front().weight);
    return channel.keys.front().pose.offset;
  });
  if (std::ranges::all_of(weights, [](double weight) { return weight == 1; })) return;
  handles_.weights = Eigen::Map<Eigen::VectorXd>(weights.data(), std::ssize(weights));
}

template <class Column>
Eigen::Matrix3Xd HandleMotion::columns(Column&& column) const {
  Eigen::Matrix3Xd result(3, handles_.targets());
  Eigen::Index l = 0;
  for (const auto& [vertex, channel] : vertices_) result.col(l++) = column(channel);
  for (const auto& [place, channel] : points_) result.col(l++) = column(channel);
  return result;
}

HandleMotion::Between HandleMotion::between(const Channel& channel, FrameNumber frame) const {
  const auto after = std::find_if(channel.keys.begin(), channel.keys.end(),
                                  [&](const Key& key) { return key.frame > frame; });
  if (after == channel.keys.begin()) return {*after, *after, 0};
  const Key& before = *std::prev(after);
  if (after == channel.keys.end()) return {before, before, 0};
  const double share =
      frames_between(before.frame, frame) / frames_between(before.frame, after->frame);
  return {before, *after, smooth_ ? ease(share) : share};
}

Eigen::Matrix3Xd HandleMotion::offsets(FrameNumber frame) const {
  return columns([&](const Channel& channel) {
    const auto [from, to, share] = between(channel, frame);
    return share == 0 ? from.pose.offset : offset_between(from.pose, to.pose, share);
  });
}

Eigen::Matrix3Xd HandleMotion::rotations(FrameNumber frame) const {
  if (!turns_) return Eigen::Matrix3Xd(3, 0);
  return columns([&](const Channel& channel) {
    const auto [from, to, share] = between(channel, frame);
    return rotation_between(from.pose.motion, to.pose.motion, share);
  });
}

std::string HandleMotion::description() const {
  std::ostringstream text;
  text << std::hexfloat << (smooth_ ? "smooth" : "linear");
  for (const int i : handles_.fixed) text << " fix " << i;
  const auto describe = [&](const Channel& channel) {
    for (const Key& key : channel.keys) {
      const auto& [rest, offset, motion] = key.pose;
      text << ' ' << key.frame << ' ' << key.weight << ' ' << offset.transpose();
      if (is_translation(motion)) continue;
      text << " about " << motion.center.transpose() << ' ' << motion.turn.transpose() << ' '
           << motion.stretch.reshaped().transpose() << " from " << rest.transpose();
    }
  };
  for (const auto& [vertex, channel] : vertices_) describe((text << " move " << vertex, channel));
  for (const auto& [place, channel] : points_) {
    text << " at " << place[0] << ' ' << place[1] << ' ' << place[2];
    describe(channel);
  }
  return text.str();
}

}  // namespace deformlab
