#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// Whether all frames of an animation have the same vertices in the same order. Frames are added
/// one after the other. A frame is refused if it has another number of vertices or other faces than
/// the first one, or if many of its edges are suddenly much longer than in the frame before. An
/// edge of a point set is a point with the one that is nearest to it in the first frame.
class FrameOrder {
 public:
  /// Throws InputError (naming the frame and its file).
  void add(const Shape& shape, FrameNumber frame, const std::filesystem::path& path);

 private:
  void begin(const Shape& shape, FrameNumber frame);
  void check_lengths(const Shape& shape, const std::string& name);

  using Faces = std::vector<std::vector<int>>;
  using Edge = std::array<int, 2>;

  Eigen::Index vertices_ = 0;
  Faces faces_;  // each from its least vertex on, in ascending order
  std::vector<Edge> edges_;
  std::vector<double> lengths_;  // in the last frame [its diagonal]
  std::optional<FrameNumber> first_;
  FrameNumber last_ = 0;
};

}  // namespace deformlab
