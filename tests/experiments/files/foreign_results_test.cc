#include <sys/stat.h>

#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// What others keep in a folder into which `run` writes.
class ForeignResults : public Program {
 protected:
  ForeignResults() { put("c.yaml", kExperiment); }

  Ending run(const Words& more = {}) const {
    Words all{"run", "c.yaml", "--out", "out"};
    all.insert(all.end(), more.begin(), more.end());
    return start(all);
  }

  ino_t file_number(const std::string& name) const {
    struct stat file = {};
    EXPECT_EQ(::lstat(place(name).c_str(), &file), 0) << name;
    return file.st_ino;
  }
  fs::perms mode(const std::string& name) const {
    return fs::symlink_status(place(name)).permissions();
  }
};

TEST_F(ForeignResults, StayAsTheyAre) {
  put("out/c/frames/0000.txt", "mine");
  put("out/c/trace_of_paper.csv", "mine");
  put("out/c/trace", "mine");
  fs::create_directory(place("out/c/empty"));
  fs::create_symlink("trace", place("out/c/link"));
  fs::create_symlink("nowhere", place("out/c/dangling"));
  ASSERT_EQ(::mkfifo(place("out/c/pipe").c_str(), 0600), 0);
  fs::permissions(place("out/c/trace"), fs::perms(0640));
  fs::permissions(place("out/c/frames"), fs::perms(0750));
  fs::permissions(place("out/c"), fs::perms(0770));
  const ino_t number = file_number("out/c/trace");
  for (int times = 0; times < 2; ++times) {
    const Ending ending = run();
    EXPECT_EQ(ending.status, 0) << ending.err;
    EXPECT_EQ(get("out/c/frames/0000.txt"), "mine");
    EXPECT_EQ(get("out/c/trace_of_paper.csv"), "mine");
    EXPECT_EQ(file_number("out/c/trace"), number);  // not a copy
    EXPECT_EQ(mode("out/c/trace"), fs::perms(0640));
    EXPECT_EQ(mode("out/c/frames"), fs::perms(0750));
    EXPECT_EQ(mode("out/c"), fs::perms(0770));
    EXPECT_TRUE(fs::is_directory(place("out/c/empty")));
    EXPECT_EQ(fs::read_symlink(place("out/c/link")), "trace");
    EXPECT_EQ(fs::read_symlink(place("out/c/dangling")), "nowhere");
    EXPECT_TRUE(fs::is_fifo(place("out/c/pipe")));
    EXPECT_TRUE(exists("out/c/metrics.json"));
  }
}

TEST_F(ForeignResults, AreNeverReplaced) {
  for (const char* name : {"config.yaml", "trace.csv", "manifest.txt", "picture.png"}) {
    fs::remove_all(place("out"));
    put("out/c/" + std::string(name), "mine");
    expect_refused({"run", "c.yaml", "--out", "out"}, {name, "no run", "choose another --out"});
  }
}

TEST_F(ForeignResults, ALinkInPlaceOfAResultIsNotOurs) {
  ASSERT_EQ(run().status, 0);
  put("elsewhere.png", "mine");
  fs::remove(place("out/c/picture.png"));
  fs::create_symlink("../../elsewhere.png", place("out/c/picture.png"));
  expect_refused({"run", "c.yaml", "--out", "out"}, {"picture.png", "no run"});
}

TEST_F(ForeignResults, APageWithoutTheMarkStays) {
  put("out/README.md", "my project\n");
  const Ending ending = run();
  EXPECT_EQ(ending.status, 0);
  EXPECT_EQ(get("out/README.md"), "my project\n");
  EXPECT_THAT(ending.err, HasSubstr("'out/README.md' was not written by deformlab"));
  fs::remove(place("out/README.md"));
  EXPECT_THAT(run().err, Not(HasSubstr("README")));
  EXPECT_THAT(get("out/README.md"), HasSubstr("## c"));
  EXPECT_EQ(run({"graph.nodes=10"}).status, 0);
  EXPECT_THAT(get("out/README.md"), HasSubstr("nodes 10"));
}

TEST_F(ForeignResults, TheFoldersMayBeLinks) {
  put("real/mine.txt", "mine");
  put("other/mine.txt", "mine");
  fs::create_directory_symlink("real", place("out"));
  fs::create_directory_symlink("../other", place("real/c"));
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(run().status, 0);
    EXPECT_TRUE(fs::is_symlink(place("out")));
    EXPECT_TRUE(fs::is_symlink(place("real/c")));
    EXPECT_TRUE(exists("other/metrics.json") && exists("other/mine.txt"));
  }
}

TEST_F(ForeignResults, TheModesOfResultsStay) {
  ASSERT_EQ(run().status, 0);
  fs::permissions(place("out/c/metrics.json"), fs::perms(0600));
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(mode("out/c/metrics.json"), fs::perms(0600));
  EXPECT_EQ(mode("out/c/picture.png"), fs::perms(0666 & ~022));
}

TEST_F(ForeignResults, OnlyTheManifestIsReplaced) {
  ASSERT_EQ(run({"sweep={graph.nodes: [10, 12]}"}).status, 0);
  put("out/c/trace_003.csv", "mine");
  ASSERT_EQ(run().status, 0);
  EXPECT_FALSE(exists("out/c/trace_001.csv"));
  EXPECT_EQ(get("out/c/trace_003.csv"), "mine");
  EXPECT_EQ(run({"sweep={graph.nodes: [10, 12, 14]}"}).status, 2);
  EXPECT_EQ(get("out/c/trace_003.csv"), "mine");
}

}  // namespace
}  // namespace deformlab::test
