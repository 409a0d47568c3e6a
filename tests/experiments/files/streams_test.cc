#include <sys/stat.h>

#include "tests/support/animations.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// What the program does with its standard streams, and the modes and names of what it writes.
class Streams : public Program {
 protected:
  Streams() {
    put("s.off", plane_off());
    put("in.csv", particle_csv());
    put("lift.yaml", kLift);
    put("stream.yaml",
        "edit:\n  - {select: {vertices: [0, 1]}, by: [0, 0, 0]}\n"
        "  - {select: {nearest: [9, 0, 0]}, by: [0, 0, 1]}\n");
  }

  /// Runs a line of the shell, in which $D is the program.
  Ending shell(const std::string& line) const {
    const std::string all = "D=" DEFORMLAB_PROGRAM_PATH "; " + line;
    return start_program(place(""), {"-c", all}, "/bin/bash");
  }
};

const std::string kParticles =
    "$D animate --particles in.csv --edit stream.yaml --out out.csv --nodes 12 ";

TEST_F(Streams, ThatAreClosedGetNoFile) {
  ASSERT_EQ(shell(kParticles).status, 0);
  const std::string expected = get("out.csv");
  for (const std::string closed : {"<&- >&- 2>&-", ">&- 2>&-", "<&- >&-", "2>&-"}) {
    fs::remove(place("out.csv"));
    EXPECT_EQ(shell(kParticles + "--minloglevel=0 " + closed).status, 0) << closed;
    EXPECT_TRUE(get("out.csv") == expected) << closed;
  }
}

TEST_F(Streams, ThatAreFullAreAnError) {
  put("c.yaml", kExperiment);
  for (const std::string& command :
       {std::string("$D help"), std::string("$D list"), std::string("$D --version"), kParticles,
        std::string("$D run c.yaml")}) {
    const Ending ending = shell(command + " >/dev/full");
    EXPECT_EQ(ending.status, 2) << command;
    EXPECT_THAT(ending.err, HasSubstr("standard output: No space left on device")) << command;
  }
}

TEST_F(Streams, ThatAreBrokenEndQuietly) {
  const Ending help = shell("set -o pipefail; { sleep 0.2; $D help; } | true");
  EXPECT_EQ(help.status, 141);
  EXPECT_EQ(help.err, "");
  // Nobody reads the messages, but the result is made.
  EXPECT_EQ(
      shell("{ sleep 0.2; " + kParticles + "2>&1 >/dev/null; echo $? >status; } | true").status, 0);
  EXPECT_EQ(get("status"), "0\n");
  EXPECT_TRUE(exists("out.csv"));
}

const std::string kDeform = "$D deform s.off --edit lift.yaml --nodes 10 --out ";

TEST_F(Streams, FilesHaveTheModesOfNormalFiles) {
  EXPECT_EQ(shell("umask 027; " + kDeform + "new.ply").status, 0);
  EXPECT_EQ(fs::status(place("new.ply")).permissions(), fs::perms(0640));
  fs::permissions(place("new.ply"), fs::perms(0604));
  EXPECT_EQ(shell(kDeform + "new.ply").status, 0);
  EXPECT_EQ(fs::status(place("new.ply")).permissions(), fs::perms(0604));
}

TEST_F(Streams, LinksAreFollowed) {
  fs::create_directory(place("far"));
  fs::create_symlink("far/there.ply", place("link.ply"));  // dangling
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(shell(kDeform + "link.ply").status, 0);
    EXPECT_TRUE(fs::is_symlink(place("link.ply")));
    EXPECT_TRUE(fs::is_regular_file(place("far/there.ply")));
  }
}

TEST_F(Streams, NamesAsLongAsPossibleAreTaken) {
  const std::string longest(251, 'a');
  EXPECT_EQ(shell(kDeform + longest + ".ply").status, 0);
  const Ending ending = shell(kDeform + longest + "a.ply");
  EXPECT_EQ(ending.status, 2);
  EXPECT_THAT(ending.err, HasSubstr("File name too long"));
}

TEST_F(Streams, TemporaryFilesOfKilledRunsAreRemoved) {
  put(".deformlab-0123456789abcdef.partial", "left");
  put(".deformlab-0123456789abcdef.mine", "mine");
  EXPECT_EQ(shell(kDeform + "out.ply").status, 0);
  EXPECT_FALSE(exists(".deformlab-0123456789abcdef.partial"));
  EXPECT_TRUE(exists(".deformlab-0123456789abcdef.mine"));
}

TEST_F(Streams, TwoRunsIntoOneFolderWaitForEachOther) {
  put("c.yaml", kExperiment);
  const Ending ending = shell(
      "mkdir results; exec 9>results/.c.deformlab-lock; flock 9; ($D run c.yaml 9>&-) & "
      "sleep 1; test ! -e results/c && flock -u 9; wait $!");
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("waiting for another run that writes 'results/c'"));
  EXPECT_FALSE(exists("results/.c.deformlab-lock"));
}

TEST_F(Streams, SixRunsAtOnceGiveOneWholeResult) {
  put("c.yaml", kExperiment);
  const Ending ending = shell(
      "for i in 1 2 3 4 5 6; do $D run c.yaml graph.nodes=$((9 + i)) & done; wait; ls -A results");
  EXPECT_THAT(ending.out, HasSubstr("README.md\nc\n"));
  EXPECT_EQ(ending.out.find(".deformlab"), std::string::npos) << ending.out;
}

}  // namespace
}  // namespace deformlab::test
