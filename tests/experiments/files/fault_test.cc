#include <csignal>
#include <cstdlib>

#include "tests/support/animations.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

/// A command that writes, with the words that make its older and its newer result. Files below
/// `unit` are of one result: all are old or all are new.
struct Written {
  std::string name;
  Words command, old_words, new_words;
  std::string unit;
  bool exchanges = true;  ///< whether the file system exchanges two folders in one step
  friend void PrintTo(const Written& test, std::ostream* out) { *out << test.name; }
};

/// Every output call of a command fails in turn.
class Faults : public Program, public ::testing::WithParamInterface<Written> {
 protected:
  Faults() {
    put("c.yaml", kExperiment);
    put("s.off", plane_off());
    put("lift.yaml", kLift);
    put("tube.yaml", kTubeEdit);
    put("stream.yaml",
        "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
        "  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n");
    for (int frame = 0; frame < 3; ++frame) {
      put("in-" + std::to_string(frame) + ".obj", tube_frame(frame));
    }
    put("in.csv", particle_csv());
    put("results/c/mine/notes.txt", "of the user");
    put("results/c/trace_of_mine.txt", "of the user");
  }
  ~Faults() override { fs::remove(log()); }

  fs::path log() const { return place("").parent_path().string() + ".log"; }

  Ending run(const Words& more, const std::string& fault = "") const {
    Words all = GetParam().command;
    all.insert(all.end(), more.begin(), more.end());
    if (fault.empty()) return start(all);
    setenv("DEFORMLAB_FAULT", (fault + ":" + log().string()).c_str(), 1);
    if (!GetParam().exchanges) setenv("DEFORMLAB_LACKS", "renameat2", 1);
    Ending ending = start_program(place(""), all, DEFORMLAB_FAULTY_PATH);
    unsetenv("DEFORMLAB_FAULT");
    unsetenv("DEFORMLAB_LACKS");
    return ending;
  }

  // Seconds differ from run to run.
  Files comparable() const {
    Files files = contents();
    std::erase_if(files, [](const auto& file) {
      return file.first.ends_with("times.json") || file.first == "m.json";
    });
    return files;
  }

  static Words differences(const Files& a, const Files& b) {
    Words names;
    for (const auto& [name, bytes] : a) {
      if (!b.contains(name) || b.at(name) != bytes) names.push_back(name);
    }
    for (const auto& [name, bytes] : b) {
      if (!a.contains(name)) names.push_back(name);
    }
    return names;
  }

  void restore(const Files& files) const {
    for (const auto& entry : fs::directory_iterator(place(""))) fs::remove_all(entry.path());
    for (const auto& [name, bytes] : files) {
      if (bytes != "folder") put(name, bytes);
    }
  }

  // No file is half written, and files of one result are of one run.
  void expect_whole(const Files& old, const Files& fresh) const {
    const std::string& unit = GetParam().unit;
    bool is_old = true, is_fresh = true;
    const Files now = contents();
    for (const auto& file : now) {
      const std::string &name = file.first, &bytes = file.second;
      const auto is_of = [&](const Files& files) {
        const auto found = files.find(name);
        return found != files.end() && found->second == bytes;
      };
      const bool temporary = name.find(".deformlab-") != std::string::npos ||
                             name.ends_with(".progress") || name.ends_with("times.json") ||
                             name == "m.json";
      if (temporary) continue;
      EXPECT_TRUE(is_of(old) || is_of(fresh)) << name;
      if (unit.empty() || !name.starts_with(unit)) continue;
      is_old = is_old && is_of(old);
      is_fresh = is_fresh && is_of(fresh);
    }
    for (const auto& [name, bytes] : old) {
      EXPECT_TRUE(now.contains(name) || name.find("mine") == std::string::npos) << name;
      if (!unit.empty() && name.starts_with(unit)) is_old = is_old && now.contains(name);
    }
    for (const auto& [name, bytes] : fresh) {
      if (!unit.empty() && name.starts_with(unit)) is_fresh = is_fresh && now.contains(name);
    }
    EXPECT_TRUE(unit.empty() || is_old || is_fresh);
  }
};

TEST_P(Faults, LeaveTheOldOrTheNewResult) {
  const auto& [name, command, old_words, new_words, unit, exchanges] = GetParam();
  ASSERT_EQ(run(old_words).status, 0);
  const Files begin = contents(), old = comparable();
  ASSERT_EQ(run(new_words).status, 0);
  const Files fresh = comparable();
  ASSERT_NE(old, fresh);
  int faults = 0;
#ifdef DEFORMLAB_SANITIZED  // slow programs; what follows a failed call is of interest to them
  const Words kinds{"always"};
#else
  const Words kinds{"die", "once", "always"};
#endif
  for (const std::string& kind : kinds) {
    for (int call = 1;; ++call) {
      SCOPED_TRACE(kind + " at call " + std::to_string(call));
      restore(begin);
      fs::remove(log());
      const Ending ending = run(new_words, std::to_string(call) + ":" + kind);
      if (!fs::exists(log())) break;  // there was no such call
      ++faults;
      if (kind == "die") {
        EXPECT_EQ(ending.status, -SIGKILL);
      } else {
        EXPECT_EQ(ending.status, 2) << ending.err;
        EXPECT_NE(ending.err.find("deformlab: cannot write"), std::string::npos) << ending.err;
      }
      // Without an exchange, a fault between two renames leaves a state that the next run mends,
      // unless the first rename can be taken back.
      if (exchanges || kind == "once") expect_whole(old, fresh);
      const Ending next = run(new_words);
      EXPECT_EQ(next.status, 0) << next.err;
      EXPECT_THAT(differences(comparable(), fresh), ::testing::IsEmpty());
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(faults, 8 * std::ssize(kinds));
  RecordProperty("faults", faults);
}

constexpr const char* kLiftOfOneEnd =
    "edit=[{select: {nearest: [0, 0, 1]}, fix: true},"
    " {select: {nearest: [4, 0, 1]}, by: [0, 0, 0.2]}]";

INSTANTIATE_TEST_SUITE_P(
    Of, Faults,
    ::testing::Values(
        Written{"Run", {"run", "c.yaml"}, {"graph.nodes=10"}, {"graph.nodes=12"}, "results/c/"},
        Written{"RunWithoutExchange",
                {"run", "c.yaml"},
                {"graph.nodes=10"},
                {"graph.nodes=12"},
                "results/c/",
                false},
        Written{"RunOfAnimation",
                {"run", "c.yaml", "animation={file: in-%d.obj, pictured: 1}", "shape={}",
                 kLiftOfOneEnd},
                {"animation.sequence={every: 1, width: 40}"},
                {"animation.sequence={every: 2, width: 40}"},
                "results/c/"},
        Written{"Deform",
                {"deform", "s.off", "--edit", "lift.yaml", "--out", "out.ply", "--metrics",
                 "m.json", "--picture", "p.png", "picture.width=40", "picture.height=30"},
                {"--nodes", "10"},
                {"--nodes", "12", "edit.1.by=[0, 0, 0.2]"},
                ""},
        Written{"AnimateFrames",
                {"animate", "--frames", "in-%d.obj", "--edit", "tube.yaml", "--out", "out-%d.obj"},
                {"--nodes", "15"},
                {"--nodes", "20"},
                ""},
        Written{"AnimateParticles",
                {"animate", "--particles", "in.csv", "--edit", "stream.yaml", "--out", "out.csv"},
                {"--nodes", "10"},
                {"--nodes", "12"},
                ""}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace deformlab::test
