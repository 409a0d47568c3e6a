#include <cstdint>
#include <limits>
#include <sstream>

#include "tests/support/animations.h"
#include "tests/support/program.h"

namespace deformlab::test {
namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min(),
                       kMost = std::numeric_limits<std::int64_t>::max();

/// Frames and ids at the ends of what 64 bits hold.
class FrameLimits : public Program {
 protected:
  FrameLimits() {
    put("tube.yaml", kTubeEdit);
    put("stream.yaml",
        "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
        "  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n");
  }

  // The particles of `particle_csv` with other frames and ids, which keep their order.
  static std::string shifted(std::int64_t frame0, std::int64_t id0) {
    std::istringstream in(particle_csv());
    std::string line, text;
    std::getline(in, line);
    text = line + "\n";
    while (std::getline(in, line)) {
      const std::size_t comma = line.find(','), next = line.find(',', comma + 1);
      const std::int64_t frame = std::stoll(line), id = std::stoll(line.substr(comma + 1));
      text += std::to_string(frame0 + frame) + "," + std::to_string(id0 + id) + line.substr(next) +
              "\n";
    }
    return text;
  }

  // The rows of a table without their frames and ids.
  std::string positions(const std::string& name) const {
    std::istringstream in(get(name));
    std::string line, text;
    while (std::getline(in, line)) text += line.substr(line.find(',', line.find(',') + 1)) + "\n";
    return text;
  }

  static Words animate(const std::string& out, const Words& more = {}) {
    Words all{"animate", "--particles", "in.csv",  "--edit", "stream.yaml",
              "--out",   out,           "--nodes", "12"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(FrameLimits, OfParticlesGiveTheSamePositions) {
  put("in.csv", particle_csv());
  expect_success(animate("plain.csv"));
  for (const std::int64_t frame : {kLeast, kMost - 19}) {
    for (const std::int64_t id : {kLeast, kMost - 19}) {
      put("in.csv", shifted(frame, id));
      expect_success(animate("out.csv", {"--picture", "p.png", "pictured=3", "picture.width=40",
                                         "picture.height=30", "--metrics", "m.json"}));
      EXPECT_EQ(positions("out.csv"), positions("plain.csv")) << frame << " " << id;
      expect_success(animate("out.csv", {"path=" + std::to_string(id)}));
    }
  }
}

TEST_F(FrameLimits, OfParticlesMayBothOccur) {
  std::string text = particle_csv();
  for (const std::int64_t frame : {kLeast, kMost}) {
    text += std::to_string(frame) + ",5,0,0,0\n" + std::to_string(frame) + ",77,1,0,0\n";
  }
  put("in.csv", text);
  expect_success(animate("out.csv"));
  put("in.csv", particle_csv() + "9223372036854775808,1,0,0,0\n");
  expect_refused(animate("other.csv"), {"frame is '9223372036854775808'", "64 bits"});
}

TEST_F(FrameLimits, KeyframesMayNameThem) {
  put("in.csv", shifted(kMost - 19, 0));
  put("stream.yaml",
      "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
      "keyframes:\n"
      "  - {frame: 9223372036854775800, edit: [{select: {vertices: [11]}, by: [0, 0, 0]}]}\n"
      "  - {frame: 9223372036854775807, edit: [{select: {vertices: [11]}, by: [0, 0, 1]}]}\n");
  expect_success(animate("out.csv"));
}

TEST_F(FrameLimits, OfMeshesAreFilesLikeOthers) {
  for (int i = 0; i < 3; ++i) {
    put("in-" + std::to_string(kMost - 2 + i) + ".obj", tube_frame(i));
    put("small-" + std::to_string(i) + ".obj", tube_frame(i));
  }
  for (const std::string name : {"in", "small"}) {
    expect_success({"animate", "--frames", name + "-%d.obj", "--edit", "tube.yaml", "--out",
                    name + "_out-%d.obj", "--nodes", "20"});
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(get("in_out-" + std::to_string(kMost - 2 + i) + ".obj"),
              get("small_out-" + std::to_string(i) + ".obj"));
  }
}

}  // namespace
}  // namespace deformlab::test
