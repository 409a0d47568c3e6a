#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class RunCommand : public Program {
 protected:
  RunCommand() { put("c.yaml", kExperiment); }

  Ending run(const Words& more = {}) const {
    Words all{"run", "c.yaml"};
    all.insert(all.end(), more.begin(), more.end());
    return start(all);
  }

  json metrics(const std::string& name = "c") const {
    return json::parse(get("results/" + name + "/metrics.json"));
  }
};

TEST_F(RunCommand, WritesAllOfAnExperiment) {
  const Ending ending = run();
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("c: run 1 of 1"));
  EXPECT_THAT(ending.out, HasSubstr("results in results/c"));
  for (const char* name : {"config.yaml", "metrics.json", "times.json", "environment.json",
                           "trace.csv", "picture.png"}) {
    EXPECT_FALSE(get("results/c/" + std::string(name)).empty()) << name;
  }
  const json m = metrics().at("runs").at(0);
  EXPECT_EQ(m.at("metrics").at("nodes"), 20);
  EXPECT_EQ(m.at("metrics").at("converged"), 1);
  EXPECT_EQ(m.at("solver").at("method"), "gauss_newton");
  EXPECT_THAT(get("results/README.md"), HasSubstr("## c\n\na small plane"));
}

TEST_F(RunCommand, GivesTheSameBytesTwiceApartFromTimes) {
  run();
  const auto first = contents();
  run();
  EXPECT_THAT(changes_since(first), ::testing::Each("results/c/times.json"));
}

TEST_F(RunCommand, TheResolvedConfigGivesTheSameAgain) {
  run({"graph.nodes=15", "energies.rotation=2"});
  EXPECT_THAT(get("results/c/config.yaml"), HasSubstr("nodes: 15"));
  put("again.yaml", get("results/c/config.yaml"));
  ASSERT_EQ(start({"run", "again.yaml"}).status, 0);
  EXPECT_EQ(metrics("again"), metrics());
  EXPECT_EQ(metrics().at("runs").at(0).at("metrics").at("nodes"), 15);
}

TEST_F(RunCommand, SweepsOverEveryCombination) {
  const Ending ending =
      run({"sweep={graph.nodes: [12, 20], solver.method: [gauss_newton, ceres]}"});
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("run 4 of 4"));
  const json runs = metrics().at("runs");
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[2].at("metrics").at("nodes"), 20);
  EXPECT_EQ(runs[3].at("solver").at("method"), "ceres");
  EXPECT_TRUE(exists("results/c/trace_004.csv"));
  EXPECT_THAT(get("results/c/table.md"), HasSubstr("| 20 | ceres |"));
}

TEST_F(RunCommand, ASingleRunAfterASweepLeavesNoTraceOfIt) {
  run({"sweep={graph.nodes: [12, 20]}"});
  run();
  EXPECT_FALSE(exists("results/c/trace_001.csv"));
  EXPECT_FALSE(exists("results/c/table.md"));
  EXPECT_TRUE(exists("results/c/trace.csv"));
}

TEST_F(RunCommand, RunsSeveralConfigsIntoOneGallery) {
  put("b.yaml", kExperiment);
  const Ending ending = run({"b.yaml", "--out", "deep/er", "picture.rest=false"});
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(get("deep/er/README.md"), AllOf(HasSubstr("## b\n"), HasSubstr("## c\n")));
  EXPECT_FALSE(exists("results"));
}

TEST_F(RunCommand, LeavesWhatOthersPutThere) {
  run();
  put("results/c/notes.txt", "mine");
  put("results/theirs/metrics.json", "{\"title\": 3, \"claims\": [4]}");
  put("results/broken/metrics.json", "{");
  EXPECT_EQ(run().status, 0);
  EXPECT_EQ(get("results/c/notes.txt"), "mine");
  EXPECT_TRUE(exists("results/theirs/metrics.json"));
  EXPECT_THAT(get("results/README.md"), AllOf(HasSubstr("## c"), Not(HasSubstr("theirs"))));
}

TEST_F(RunCommand, ReadsAShapeBesideTheConfig) {
  put("deep/s.off", plane_off());
  put("deep/d.yaml",
      "shape: {file: s.off}\ngraph: {nodes: 10}\npicture: {width: 40, height: 30}\n" +
          std::string(kLift));
  EXPECT_EQ(start({"run", "deep/d.yaml"}).status, 0);
  EXPECT_EQ(metrics("d").at("runs").at(0).at("metrics").at("vertices"), 81);
}

TEST_F(RunCommand, ASolverThatFailsIsNoSuccess) {
  const Ending ending =
      run({"energies.rotation=1e308", "claims=[{name: cheap, measure: cost, at_most: 1}]"});
  EXPECT_EQ(ending.status, 1);
  EXPECT_THAT(ending.out, AllOf(HasSubstr("the solver failed"), HasSubstr("falls short")));
}

/// Claims of a sweep over two numbers of nodes, the exit status, and what is said.
struct Claimed {
  std::string name, claim;
  int status;
  std::string says;
  friend void PrintTo(const Claimed& test, std::ostream* out) { *out << test.name; }
};
class Claims : public RunCommand, public ::testing::WithParamInterface<Claimed> {};

TEST_P(Claims, AreCheckedAndTold) {
  const Ending ending = run({"sweep={graph.nodes: [10, 20]}",
                             "claims=[{name: it, measure: nodes, " + GetParam().claim + "}]"});
  EXPECT_EQ(ending.status, GetParam().status) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("claim it: measured " + GetParam().says + "\n"));
  const json claim = metrics().at("claims").at(0);
  const bool holds = GetParam().says.ends_with(" ok");
  EXPECT_EQ(claim.at("holds"), holds);
  EXPECT_THAT(get("results/README.md"), HasSubstr(holds ? "| ok" : "**falls short**"));
}

INSTANTIATE_TEST_SUITE_P(
    Of, Claims,
    ::testing::Values(
        Claimed{"AtLeast", "at_least: 10", 0, "10, expected at least 10 ok"},
        Claimed{"AtLeastWorst", "at_least: 11", 1, "10, expected at least 11 falls short"},
        Claimed{"AtMostWorst", "at_most: 15", 1, "20, expected at most 15 falls short"},
        Claimed{"Both", "at_least: 9, at_most: 20.5", 0,
                "20, expected at least 9, at most 20.5 ok"},
        Claimed{"Known", "at_most: 15, known: as said", 0,
                "20, expected at most 15 falls short (known: as said)"},
        Claimed{"Where", "where: {graph.nodes: 10}, equals: 10", 0, "10, expected 10 ok"},
        Claimed{"Within", "over: mean, equals: 14, within: 0.08", 0,
                "15, expected 14 within 8 % ok"},
        Claimed{"NotWithin", "over: mean, equals: 14, within: 0.07", 1,
                "15, expected 14 within 7 % falls short"},
        Claimed{"Spread", "over: spread, at_most: 0.67", 0, "0.6667, expected at most 0.67 ok"},
        Claimed{"Range", "over: range, at_most: 10", 0, "10, expected at most 10 ok"},
        Claimed{"Per", "per: nodes, equals: 1", 0, "1, expected 1 ok"},
        Claimed{"Exponent", "over: exponent, against: nodes, equals: 1, within: 1e-9", 0,
                "1, expected 1 within 1e-07 % ok"},
        Claimed{"OneOfAList", "where: {graph.nodes: [10, 30]}, equals: 10", 0,
                "10, expected 10 ok"},
        Claimed{"Versus", "where: {graph.nodes: 20}, versus: {graph.nodes: 10}, equals: 2", 0,
                "2, expected 2 ok"}),
    [](const auto& test) { return test.param.name; });

TEST_F(Program, HelpNamesEveryKeyAndListEveryEnergy) {
  const Ending help = expect_success({"help"});
  EXPECT_THAT(help.out, AllOf(HasSubstr("--edit EDIT.yaml"), HasSubstr("graph.nodes"),
                              HasSubstr("claims[].at_least"), HasSubstr("select.nearest")));
  EXPECT_EQ(expect_success({}).out, help.out);
  EXPECT_EQ(expect_success({"deform", "--help"}).out, help.out);
  EXPECT_THAT(expect_success({"list"}).out,
              AllOf(HasSubstr("rotation"), HasSubstr("cholmod"), HasSubstr("dogleg")));
}

}  // namespace
}  // namespace deformlab::test
