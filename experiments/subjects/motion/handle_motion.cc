#include "experiments/subjects/motion/handle_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "experiments/measure/drag.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

void check_frame(FrameTime frame, const FrameRange& range, const std::string& what) {
  if (frame >= static_cast<FrameTime>(range.first) && frame <= static_cast<FrameTime>(range.last)) {
    return;
  }
  throw InputError(fmt::format("{} names frame {}; the frames are {} to {}", what, text_of(frame),
                               range.first, range.last));
}

// The frame whose pose a moment refers to.
FrameNumber nearest_frame(const std::optional<FrameTime>& moment, const FrameRange& range) {
  return moment ? static_cast<FrameNumber>(std::llround(*moment)) : range.first;
}

Resolve resolve_in_shapes(const std::function<Shape(FrameNumber)>& pose_of) {
  return [&pose_of](const std::vector<EditEntry>& entries, FrameNumber frame) {
    const Shape pose = pose_of(frame);
    ResolvedEdit edit = resolve(entries, pose);
    Eigen::Matrix3Xd rest = targets_at_rest(pose, edit.handles);
    return PosedEdit{std::move(edit), std::move(rest)};
  };
}

[[noreturn]] void throw_fixed_and_moved(int vertex, const std::string& fixing,
                                        const std::string& moving) {
  throw InputError(
      fmt::format("vertex {} is fixed by {} and moved by {}; a vertex that is fixed is "
                  "fixed in all frames",
                  vertex, fixing, moving));
}

}  // namespace

HandleMotion::HandleMotion(const Script& script, const FrameRange& range,
                           const std::function<Shape(FrameNumber)>& pose_of)
    : HandleMotion(script, range, resolve_in_shapes(pose_of)) {}

HandleMotion::HandleMotion(const Script& script, const FrameRange& range, const Resolve& resolve_in)
    : interpolation_(script.interpolation), weights_(script.weights) {
  if (script.pose) check_frame(static_cast<FrameTime>(*script.pose), range, "'pose'");
  for (const TimedEdit& edit : script.edits) {
    if (!edit.frame) continue;
    if (weights_) {
      poses_.push_back(edit.where);
    } else {
      check_frame(*edit.frame, range, edit.where);
    }
  }
  for (const TimedEdit& edit : script.edits) {
    const FrameNumber pose = script.pose.value_or(nearest_frame(edit.frame, range));
    add(edit, resolve_in(edit.entries, pose));
  }
  collect();
}

void HandleMotion::add(const TimedEdit& edit, const PosedEdit& posed) {
  const auto& [resolved, rest] = posed;
  const Handles& handles = resolved.handles;
  const auto key = [&, &edited = resolved, &at = rest](Eigen::Index l) {
    const int group = handles.groups[static_cast<std::size_t>(l)];
    const double weight = handles.weights.size() == 0 ? 1 : handles.weights[l];
    const Eigen::Vector3d offset = edited.targets.col(l) - at.col(l);
    return Key{edit.frame.value_or(0),
               {at.col(l), offset, edited.motions[static_cast<std::size_t>(group)]},
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
    channel.always = !edit.frame;
  } else if (channel.where == edit.where) {
    throw InputError(fmt::format("{} is moved twice by {}; keep one", what, edit.where));
  } else if (channel.always) {
    throw InputError(fmt::format("{} is moved by {}, which is of all frames, and by {}; keep one",
                                 what, channel.where, edit.where));
  }
  channel.where = edit.where;
  channel.keys.push_back(key);
}

// A pose that does not name a handle says nothing about it, so that nothing can be blended.
void HandleMotion::check_poses(const Channel& channel, const std::string& handle) const {
  if (!weights_ || channel.always) return;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const auto is_it = [&](const Key& key) { return key.moment == static_cast<FrameTime>(i); };
    if (std::ranges::any_of(channel.keys, is_it)) continue;
    throw InputError(fmt::format(
        "{} does not name {}, which {} names; each pose says where each handle is, 'by: "
        "[0, 0]' where it stays",
        poses_[i], handle, channel.where));
  }
}

void HandleMotion::collect() {
  for (const auto& [vertex, channel] : vertices_) {
    check_poses(channel, fmt::format("vertex {}", vertex));
  }
  for (const auto& [place, channel] : points_) {
    check_poses(channel, fmt::format("the point ({:g}, {:g})", place[0], place[1]));
  }
  for (const auto& [vertex, edit] : fixed_) handles_.fixed.push_back(vertex);
  for (const auto& [vertex, channel] : vertices_) handles_.moved.push_back(vertex);
  handles_.points.resize(3, std::ssize(points_));
  Eigen::Index l = 0;
  for (const auto& [place, channel] : points_) {
    handles_.points.col(l++) << place[0], place[1], place[2];
  }
  for_each_channel(*this, [](Channel& channel) {
    std::vector<Pose> poses;
    for (const Key& key : channel.keys) {
      poses.push_back(key.pose);
      channel.moments.push_back(key.moment);
    }
    channel.numbers = numbers_of(poses);
  });
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

template <class Self, class Visit>
void HandleMotion::for_each_channel(Self& self, Visit&& visit) {
  for (auto& [vertex, channel] : self.vertices_) visit(channel);
  for (auto& [place, channel] : self.points_) visit(channel);
}

template <class Column>
Eigen::Matrix3Xd HandleMotion::columns(Column&& column) const {
  Eigen::Matrix3Xd result(3, handles_.targets());
  Eigen::Index l = 0;
  for_each_channel(*this, [&](const Channel& channel) { result.col(l++) = column(channel); });
  return result;
}

Eigen::Vector3d HandleMotion::offset(const Channel& channel, FrameTime moment) const {
  const Between b = between(channel.moments, moment);
  if (b.share == 0) return channel.keys[b.from].pose.offset;
  return offset_of(interpolated(channel.moments, channel.numbers, moment, interpolation_));
}

// NaN where neither key around the moment says anything about a rotation.
Eigen::Vector3d HandleMotion::rotation(const Channel& channel, FrameTime moment) const {
  const Between b = between(channel.moments, moment);
  const Eigen::Vector3d& from = channel.keys[b.from].pose.motion.turn;
  if (from.hasNaN() && channel.keys[b.to].pose.motion.turn.hasNaN()) return from;
  return interpolated(channel.moments, channel.numbers, moment, interpolation_)
      .segment<3>(kTurnOfNumbers);
}

Eigen::Matrix3Xd HandleMotion::offsets(FrameNumber frame) const {
  if (!weights_) {
    const auto moment = static_cast<FrameTime>(frame);
    return columns([&](const Channel& channel) { return offset(channel, moment); });
  }
  const Eigen::VectorXd weights = weights_(frame);
  return columns([&](const Channel& channel) -> Eigen::Vector3d {
    if (channel.always) return channel.keys.front().pose.offset;
    return offset_of(blended(channel.numbers, weights));
  });
}

Eigen::Matrix3Xd HandleMotion::offsets_of_pose(std::size_t pose) const {
  return columns(
      [&](const Channel& channel) { return channel.keys[channel.always ? 0 : pose].pose.offset; });
}

Eigen::Matrix3Xd HandleMotion::rotations(FrameNumber frame) const {
  if (!turns_) return Eigen::Matrix3Xd(3, 0);
  if (!weights_) {
    const auto moment = static_cast<FrameTime>(frame);
    return columns([&](const Channel& channel) { return rotation(channel, moment); });
  }
  const Eigen::VectorXd weights = weights_(frame);
  return columns([&](const Channel& channel) -> Eigen::Vector3d {
    const bool known = std::ranges::any_of(
        channel.keys, [](const Key& key) { return !key.pose.motion.turn.hasNaN(); });
    if (channel.always || !known) return channel.keys.front().pose.motion.turn;
    return blended(channel.numbers, weights).segment<3>(kTurnOfNumbers);
  });
}

std::string HandleMotion::description() const {
  std::ostringstream text;
  text << std::hexfloat << name_of(interpolation_);
  for (const int i : handles_.fixed) text << " fix " << i;
  const auto describe = [&](const Channel& channel) {
    for (const Key& key : channel.keys) {
      const auto& [rest, offset, motion] = key.pose;
      text << ' ' << key.moment << ' ' << key.weight << ' ' << offset.transpose();
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
