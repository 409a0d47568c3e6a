#pragma once

#include <Eigen/Geometry>
#include <cstdio>
#include <string>

#include "tests/support/shapes.h"

namespace deformlab::test {

/// An OBJ of a tube that bends more and more with its frames; the text after the vertices is kept
/// by whoever copies the file.
inline std::string tube_frame(int frame, int rings = 10) {
  const Shape rest = tube(rings);
  std::string text = "# frame " + std::to_string(frame) + "\n";
  for (const auto v : rest.V.colwise()) {
    const Eigen::Vector3d p =
        Eigen::AngleAxisd(0.01 * frame * v.x(), Eigen::Vector3d::UnitZ()) * v.eval();
    char line[100];
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
    text += line;
  }
  for (const auto& face : rest.faces) {
    text += "f";
    for (const int v : face) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

/// The first ring stays, the last goes up.
inline const char* const kTubeEdit =
    "edit:\n"
    "  - {select: {box: {min: [-1, -2, -2], max: [0.1, 2, 2]}}, fix: true}\n"
    "  - {select: {vertices: [108, 111, 114, 117]}, by: [0, 0, 0.5]}\n";

/// Particles that go along x, each at a place beside it, born one a frame and alive for ten:
/// frame,id,x,y,z.
inline std::string particle_csv(int frames = 20) {
  std::string text = "frame,id,x,y,z\n";
  for (int frame = 0; frame < frames; ++frame) {
    for (int id = std::max(0, frame - 9); id <= frame; ++id) {
      char line[100];
      std::snprintf(line, sizeof line, "%d,%d,%.9g,%.9g,%.9g\n", frame, id, 0.5 * (frame - id),
                    0.1 * std::sin(id), 0.1 * std::cos(id));
      text += line;
    }
  }
  return text;
}

}  // namespace deformlab::test
