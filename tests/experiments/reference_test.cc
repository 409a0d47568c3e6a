#include "experiments/measure/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "geometry/core/error.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

Run placed(const Eigen::Matrix3Xd& V, double size) {
  Run run;
  run.V = V;
  run.size = size;
  return run;
}

TEST(Reference, IsComparedVertexByVertexInDiagonals) {
  Eigen::Matrix3Xd V = Eigen::Matrix3Xd::Zero(3, 4), W = V;
  W.col(2) << 0, 3, 4;
  const Metrics m = difference(placed(W, 7), placed(V, 10));
  EXPECT_DOUBLE_EQ(m.at("reference_rms"), 0.25);
  EXPECT_DOUBLE_EQ(m.at("reference_max"), 0.5);
  EXPECT_THROW(difference(placed(V.leftCols(3), 1), placed(V, 1)), InputError);
  EXPECT_THROW(difference(placed({}, 1), placed({}, 1)), InputError);
}

class ReferenceRun : public Program {
 protected:
  ReferenceRun() { put("c.yaml", kExperiment); }
  Ending run(const std::string& reference) {
    return start(
        {"run", "c.yaml", "sweep={graph.nodes: [12, 16, 20]}", "measure.reference=" + reference});
  }
};

TEST_F(ReferenceRun, IsItsOwnAndOthersDiffer) {
  const Ending ending = run("{graph.nodes: 20}");
  ASSERT_EQ(ending.status, 0) << ending.err;
  const auto runs = nlohmann::json::parse(get("results/c/metrics.json")).at("runs");
  EXPECT_EQ(runs[2].at("metrics").at("reference_rms"), 0);
  EXPECT_EQ(runs[2].at("metrics").at("reference_max"), 0);
  for (const int i : {0, 1}) {
    const double rms = runs[i].at("metrics").at("reference_rms");
    EXPECT_GT(rms, 0);
    EXPECT_GE(runs[i].at("metrics").at("reference_max"), rms);
  }
}

TEST_F(ReferenceRun, HasToBeOne) {
  for (const char* reference : {"{graph.nodes: 13}", "{}", "{graph.seed: 1}"}) {
    const Ending ending = run(reference);
    EXPECT_EQ(ending.status, 2) << reference;
    EXPECT_THAT(ending.err, HasSubstr("of 3 runs")) << reference;
    EXPECT_FALSE(exists("results")) << reference;
  }
  EXPECT_THAT(run("20").err, HasSubstr("measure.reference"));
}

}  // namespace
}  // namespace deformlab::test
