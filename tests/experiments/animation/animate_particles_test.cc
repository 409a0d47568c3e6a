#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/animations.h"
#include "tests/support/program.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The first node stays, the last goes up.
const char* const kStreamEdit =
    "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
    "  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n";

struct Row {
  int frame, id;
  double x, y, z;
};

class AnimateParticles : public Program {
 protected:
  AnimateParticles() {
    put("in.csv", particle_csv());
    put("edit.yaml", kStreamEdit);
  }

  static Words words(const Words& more = {}) {
    Words all{"animate", "--particles", "in.csv",  "--edit", "edit.yaml",
              "--out",   "out.csv",     "--nodes", "12"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::vector<Row> rows(const std::string& file) const {
    std::istringstream text(get(file));
    std::string line;
    std::getline(text, line);
    std::vector<Row> result;
    while (std::getline(text, line)) {
      Row& r = result.emplace_back();
      EXPECT_EQ(std::sscanf(line.c_str(), "%d,%d,%lf,%lf,%lf", &r.frame, &r.id, &r.x, &r.y, &r.z),
                5)
          << line;
    }
    return result;
  }
};

TEST_F(AnimateParticles, BendsTheStream) {
  const Ending ending = expect_success(words());
  EXPECT_THAT(ending.out, HasSubstr("12 nodes on the path of particle 0"));
  EXPECT_EQ(get("out.csv").substr(0, 15), "frame,id,x,y,z\n");
  const std::vector<Row> in = rows("in.csv"), out = rows("out.csv");
  ASSERT_EQ(in.size(), out.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    EXPECT_EQ(in[i].frame, out[i].frame);
    EXPECT_EQ(in[i].id, out[i].id);
    const double up = out[i].z - in[i].z;
    if (in[i].x == 0) {
      EXPECT_NEAR(up, 0, 0.05);
    }
    if (in[i].x == 4.5) {
      EXPECT_NEAR(up, 1, 0.05);
    }
  }
}

TEST_F(AnimateParticles, TheSameBytesTwiceAndForAnyOrderOfRows) {
  expect_success(words());
  const std::string first = get("out.csv");
  expect_success(words());
  EXPECT_EQ(get("out.csv"), first);
  std::istringstream text(get("in.csv"));
  std::string header, line;
  std::getline(text, header);
  Words lines;
  while (std::getline(text, line)) lines.push_back(line);
  const auto id = [](const std::string& row) { return std::stoi(row.substr(row.find(',') + 1)); };
  std::ranges::stable_sort(lines, {}, id);
  std::string sorted = header + "\n";
  for (const std::string& row : lines) sorted += row + "\n";
  put("in.csv", sorted);
  const Ending ending = expect_success(words());
  EXPECT_THAT(ending.err, HasSubstr("not in order of frames"));
  std::vector<Row> in = rows("in.csv"), out = rows("out.csv");
  for (std::size_t i = 0; i < in.size(); ++i) EXPECT_EQ(in[i].id, out[i].id);
  put("before.csv", first);
  std::vector<Row> before = rows("before.csv");
  std::ranges::stable_sort(before, {}, &Row::id);
  for (std::size_t i = 0; i < in.size(); ++i) EXPECT_EQ(before[i].z, out[i].z);
}

TEST_F(AnimateParticles, DrawsAndMeasuresThem) {
  expect_success(words());
  const std::string out = get("out.csv");
  const Words more{"--picture",        "p.png",      "--metrics",
                   "m.json",           "pictured=3", "picture.width=80",
                   "picture.height=60"};
  expect_success(words(more));
  EXPECT_TRUE(get("out.csv") == out);
  const std::string picture = get("p.png");
  EXPECT_EQ(picture.substr(1, 3), "PNG");
  const auto m = nlohmann::json::parse(get("m.json"));
  EXPECT_EQ(m.at("frames"), 20);
  EXPECT_EQ(m.at("solves"), 1);
  EXPECT_EQ(m.at("handles"), 3);
  EXPECT_NEAR(m.at("particles").get<double>(), rows("in.csv").size() / 20.0, 1e-9);
  EXPECT_NEAR(m.at("speed_ratio").get<double>(), 1, 0.1);
  EXPECT_FALSE(m.contains("speed_correlation"));  // all are as fast
  expect_success(words(more));
  EXPECT_TRUE(get("p.png") == picture);
}

TEST_F(AnimateParticles, OnlyAnotherMethodReplacesTheDefaultLinearSolver) {
  const auto solver = [&](const std::string& setting) -> std::string {
    expect_success(words({"--metrics", "m.json", setting}));
    return nlohmann::json::parse(get("m.json")).at("linear_solver");
  };
  EXPECT_EQ(solver("solver.threads=1"), "kronecker_cg");
  EXPECT_EQ(solver("solver.linear_solver=cholmod"), "cholmod");
  EXPECT_THAT(solver("solver.method=ceres"), Not("kronecker_cg"));
}

TEST_F(AnimateParticles, KeepsOtherColumnsBlanksAndLineEnds) {
  put("in.csv",
      "id, z ,frame,mass,x,y\r\n7, 0 ,0, heavy,0,0\r\n\r\n7,0,1,light,1,0\r\n8,0,1,,2,0.5\r\n7,0,2,"
      "light,2,0");
  put("edit.yaml", "edit:\n  - {select: {all: true}, by: [1, 0, 0]}\n");
  expect_success(words());
  const std::string out = get("out.csv");
  EXPECT_EQ(out.substr(0, out.find('\n') + 1), "id, z ,frame,mass,x,y\r\n");
  EXPECT_THAT(out, HasSubstr(",0, heavy,"));
  EXPECT_THAT(out, HasSubstr("\r\n\r\n7,"));
  EXPECT_EQ(std::ranges::count(out, '\n'), 5);
  EXPECT_FALSE(out.ends_with("\n"));
  double x = 0;
  EXPECT_EQ(std::sscanf(out.c_str() + out.rfind("light,") + 6, "%lf", &x), 1);
  EXPECT_NEAR(x, 3, 1e-6);
}

TEST_F(AnimateParticles, ARowWithoutAPositionStaysAsItIs) {
  expect_success(words());
  const std::string whole = get("out.csv");
  const std::string missing = "2,77,1.50,nan,0\r\n";
  std::string in = get("in.csv");
  in.insert(in.find("\n2,") + 1, missing);
  for (const bool at_end : {false, true}) {
    put("in.csv", at_end ? in + "0,78,NaN,0,0\n" : in);
    const Ending ending = expect_success(words());
    EXPECT_THAT(ending.err, HasSubstr("no position (NaN)"));
    std::string out = get("out.csv");
    const std::size_t at = out.find(missing);
    ASSERT_NE(at, std::string::npos);
    out.erase(at, missing.size());
    EXPECT_EQ(out, at_end ? whole + "0,78,NaN,0,0\n" : whole);
  }
}

TEST_F(AnimateParticles, WithoutAnOffsetTheOutputIsTheInput) {
  put("edit.yaml", "edit:\n  - {select: {all: true}, by: [0, 0, 0]}\n");
  expect_success(words());
  const std::vector<Row> in = rows("in.csv"), out = rows("out.csv");
  for (std::size_t i = 0; i < in.size(); ++i) {
    EXPECT_NEAR(in[i].x, out[i].x, 1e-12);
    EXPECT_NEAR(in[i].y, out[i].y, 1e-12);
    EXPECT_NEAR(in[i].z, out[i].z, 1e-12);
  }
}

TEST_F(AnimateParticles, KeyframesChangeTheEditWithTime) {
  put("edit.yaml",
      "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
      "keyframes:\n"
      "  - {frame: 0, edit: [{select: {point: [4.5, 0, 0]}, by: [0, 0, 0]}]}\n"
      "  - {frame: 19, edit: [{select: {point: [4.5, 0, 0]}, by: [0, 0, 1]}]}\n");
  expect_success(words());
  const std::vector<Row> in = rows("in.csv"), out = rows("out.csv");
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (in[i].x == 4.5) {
      EXPECT_NEAR(out[i].z - in[i].z, in[i].frame / 19.0, 0.05) << i;
    }
  }
}

TEST_F(AnimateParticles, TakesThePathOfTheParticleThatIsNamed) {
  EXPECT_THAT(expect_success(words({"path=15"})).out,
              HasSubstr("on the path of particle 15, frames 15 to 19"));
}

}  // namespace
}  // namespace deformlab::test
