#pragma once

#include <string>

#include "drawing/binding.h"
#include "geometry/plane/locator.h"
#include "geometry/shape/shape_io.h"
#include "tests/support/drawing_program.h"

namespace deformlab::test {

/// Holds the left end of the bar in all frames.
inline constexpr const char* kHeld = "edit:\n  - {select: {point: [15, 40]}, fix: true}\n";

inline std::string key(const std::string& moment, const std::string& motion) {
  return "  - {" + moment + ", edit: [{select: {point: [105, 40]}, " + motion + "}]}\n";
}

inline std::string keys(const std::string& more = "") {
  return std::string(kHeld) + more + "keyframes:\n" + key("frame: 0", "by: [0, 0]") +
         key("frame: 4", "by: [0, 20]") + key("frame: 12", "by: [0, 40]");
}

inline std::string name(const std::string& prefix, int frame, const std::string& ending) {
  return prefix + (frame < 10 ? "0" : "") + std::to_string(frame) + ending;
}

/// A bar is animated whose left end stays.
class AnimateDrawing : public DrawingProgram {
 protected:
  AnimateDrawing() {
    put_bitmap("bar.png", bar());
    put("keys.yaml", keys());
  }

  static Words words(const std::string& out, const Words& more = {}) {
    Words all{"animate", "bar.png", "--edit", "keys.yaml", "--out", out, "--vertices", "60"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// Where a place of the bar is in a frame that was written as o-%02d.obj.
  Eigen::Vector2d place_in(int frame, const Eigen::Vector2d& at) const {
    put_rest();
    const Triangulation rest = read_flat("rest.obj");
    return Binding(rest, Locator(rest), at)(read_flat(name("o-", frame, ".obj")).V);
  }

  Triangulation read_flat(const std::string& file) const {
    const Shape shape = read_shape(place(file));
    Triangulation mesh{shape.V.topRows<2>(), Eigen::Matrix3Xi(3, std::ssize(shape.faces))};
    for (Eigen::Index f = 0; f < mesh.F.cols(); ++f) {
      mesh.F.col(f) = Eigen::Map<const Eigen::Vector3i>(shape.faces[f].data());
    }
    return mesh;
  }

  void put_rest() const {
    if (exists("rest.obj")) return;
    put("stay.yaml", "edit:\n  - {select: {point: [15, 40]}, by: [0, 0]}\n");
    expect_success(
        {"deform", "bar.png", "--edit", "stay.yaml", "--out", "rest.obj", "--vertices", "60"});
  }

  double way_of_the_end(int frame) const { return place_in(frame, {105, 40}).y() - 40; }
};

}  // namespace deformlab::test
