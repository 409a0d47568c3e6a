#include "drawing/bitmap/uncovered_squares.h"

#include <algorithm>

#include "drawing/bitmap/triangle_pixels.h"

namespace deformlab {
namespace {

/// Whether the mesh covers the centre of each pixel, in rows.
std::vector<bool> covered_by(const Triangulation& mesh, int width, int height) {
  std::vector<bool> covered(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (Eigen::Index f = 0; f < mesh.F.cols(); ++f)
    for_each_pixel(corners(mesh.V, mesh.F, f), {0, 0, width, height},
                   [&](int x, int y, const Eigen::Vector3d&) {
                     covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x)] = true;
                   });
  return covered;
}

/// Collects the squares and numbers their corners.
class UncoveredSquares {
 public:
  UncoveredSquares(const Bitmap& texture, const Triangulation& mesh)
      : texture_(texture), covered_(covered_by(mesh, texture.width, texture.height)) {}

  Triangulation squares() {
    step_ = 1 + std::max(texture_.width, texture_.height) / 2000;
    across_ = (texture_.width - 1) / step_ + 3;
    number_.assign(static_cast<std::size_t>(across_) *
                       static_cast<std::size_t>((texture_.height - 1) / step_ + 3),
                   -1);
    for (int y = -1; y * step_ < texture_.height; ++y)
      for (int x = -1; x * step_ < texture_.width; ++x)
        if (needed(x * step_, y * step_)) add(x, y);
    return {Eigen::Matrix2Xd::Map(corners_.data(), 2, std::ssize(corners_) / 2),
            Eigen::Matrix3Xi::Map(triangles_.data(), 3, std::ssize(triangles_) / 3)};
  }

 private:
  bool needed(int left, int top) const {
    bool drawn = false, uncovered = false;
    for (int y = top; y <= top + step_; ++y)
      for (int x = left; x <= left + step_; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < texture_.width && y < texture_.height;
        drawn = drawn || (inside && texture_.pixel(x, y)[3] != 0);
        uncovered =
            uncovered || !inside ||
            !covered_[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture_.width) +
                      static_cast<std::size_t>(x)];
      }
    return drawn && uncovered;
  }

  int vertex(int x, int y) {
    int& number = number_[static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(across_) +
                          static_cast<std::size_t>(x + 1)];
    if (number < 0) {
      number = static_cast<int>(corners_.size() / 2);
      corners_.insert(corners_.end(), {x * step_ + 0.5, y * step_ + 0.5});
    }
    return number;
  }

  void add(int x, int y) {
    const int a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
              d = vertex(x, y + 1);
    triangles_.insert(triangles_.end(), {a, b, c, a, c, d});
  }

  const Bitmap& texture_;
  std::vector<bool> covered_;
  int step_ = 1, across_ = 0;
  std::vector<int> number_, triangles_;
  std::vector<double> corners_;
};

}  // namespace

Triangulation uncovered_squares(const Triangulation& mesh, const Bitmap& texture) {
  return UncoveredSquares(texture, mesh).squares();
}

}  // namespace deformlab
