#include <csignal>

#include "tests/support/animated_bar.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A run over more frames that is killed on the way.
class AnimateDrawingResumed : public AnimateDrawing {
 protected:
  static constexpr int kFrames = 60;

  AnimateDrawingResumed() {
    put("keys.yaml", std::string(kHeld) + "keyframes:\n" + key("frame: 0", "by: [0, 0]") +
                         key("frame: 30", "by: [-60, 30]") + key("frame: 59", "by: [-60, -40]"));
  }

  // Kills the program as soon as it has made a frame. On a busy machine it may be done before.
  void start_and_kill(const std::string& frame) const {
    for (int attempt = 0; attempt < 5; ++attempt) {
      for (int i = 0; i < kFrames; ++i) std::filesystem::remove(place(name("f-", i, ".png")));
      const pid_t child = begin();
      while (!exists(frame) && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      if (exists(frame) && !exists(name("f-", kFrames - 1, ".png"))) break;
    }
    ASSERT_TRUE(exists("f-%02d.png.progress"));
  }

  pid_t begin() const { return begin_program(place(""), words("f-%02d.png")); }
};

TEST_F(AnimateDrawingResumed, GoesOnToTheSameBytes) {
  expect_success(words("whole-%02d.png"));
  start_and_kill("f-03.png");
  const Ending ending = expect_success(words("f-%02d.png"));
  EXPECT_THAT(ending.out, Not(HasSubstr("60 of them made now")));
  EXPECT_THAT(ending.err, Not(HasSubstr("starting over")));
  for (int frame = 0; frame < kFrames; ++frame) {
    EXPECT_TRUE(get(name("f-", frame, ".png")) == get(name("whole-", frame, ".png"))) << frame;
  }
  EXPECT_FALSE(exists("f-%02d.png.progress"));
}

TEST_F(AnimateDrawingResumed, StartsOverWhereTheKeysChanged) {
  start_and_kill("f-03.png");
  put("keys.yaml", keys());
  const Ending ending = expect_success(words("f-%02d.png"));
  EXPECT_THAT(ending.err, HasSubstr("starting over"));
  EXPECT_THAT(ending.out, HasSubstr("13 of them made now"));
}

}  // namespace
}  // namespace deformlab::test
