#include <sys/stat.h>

#include "experiments/config/config_node.h"
#include "experiments/config/yaml_check.h"
#include "geometry/core/error.h"
#include "tests/support/program.h"
#include "tests/support/scenes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const std::string& yaml) {
  try {
    parse_yaml(yaml, std::make_shared<const ConfigSource>(ConfigSource{"c.yaml", {}}));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(YamlLimits, BytesAreCountedWithAliases) {
  std::string text = "a: &a " + std::string(50'000, 'x') + "\nb: [";
  for (int i = 0; i < 20'000; ++i) text += "*a, ";
  EXPECT_THAT(refusal(text + "*a]\n"),
              AllOf(HasSubstr("32 MiB of text (line 2 of c.yaml)"), HasSubstr("aliases expanded")));
}

TEST(YamlLimits, ValuesAreCountedWithAliasesOfAliases) {
  std::string text = "a0: &a0 [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before + ", " + before +
            ", " + before + "]\n";
  }
  EXPECT_THAT(refusal(text), HasSubstr("more than 1000000 values"));
}

TEST(YamlLimits, ManyValuesAreRefusedWhileTheyAreRead) {
  std::string text = "a: [";
  for (int i = 0; i < 3'000'000; ++i) text += "1,";
  text += "&";  // the text is no YAML at its end, which is not reached
  EXPECT_THAT(refusal(text), HasSubstr("more than 1000000 values"));
}

TEST(YamlLimits, KeysAreNoValues) {
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text += "k" + std::to_string(i) + ": &a" + std::to_string(i) + " 1\n";
  EXPECT_EQ(refusal(text), "");
}

TEST(YamlLimits, TextHasToBeUtf8) {
  EXPECT_THAT(refusal("a: 1\nb: caf\xE9\n"),
              AllOf(HasSubstr("0xE9 is not UTF-8 (line 2 of c.yaml)"), HasSubstr("save the file")));
  for (const std::string good : {"", "a", "\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF",
                                 "\xEF\xBB\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_EQ(find_invalid_utf8(good), std::string::npos) << good;
  }
  for (const std::string bad :
       {"\x80", "\xC0\x80", "\xC1\xBF", "\xC2", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80", "\xE2\x82", "\xFF"}) {
    EXPECT_EQ(find_invalid_utf8("ab" + bad), 2u) << bad;
  }
}

/// Inputs that are no files.
class SpecialFiles : public Program {
 protected:
  SpecialFiles() {
    put("s.off", plane_off());
    put("edit.yaml", kLift);
    put("bend.yaml", "edit:\n  - {select: {all: true}, by: [0, 0]}\n");
    EXPECT_EQ(::mkfifo(place("pipe.off").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/null", place("zero.off"));
    std::filesystem::create_symlink("/dev/null", place("zero.csv"));
    std::filesystem::create_symlink("/dev/null", place("zero.yaml"));
    std::filesystem::create_symlink("/dev/null", place("zero.svg"));
    std::filesystem::create_symlink("/dev/null", place("zero.png"));
  }
};

TEST_F(SpecialFiles, AreRefused) {
  const auto deform = [](const std::string& shape, const std::string& edit = "edit.yaml") {
    const std::string out = shape.substr(shape.find('.'));
    return Words{"deform", shape, "--edit", edit, "--out", "out" + out};
  };
  const std::pair<Words, std::string> refusals[] = {
      {deform("pipe.off"), "cannot read 'pipe.off': it is a pipe; name a file"},
      {deform("zero.off"), "cannot read 'zero.off': it is a device; name a file"},
      {deform("zero.svg", "bend.yaml"), "cannot read 'zero.svg': it is a device; name a file"},
      {deform("zero.png", "bend.yaml"), "cannot read 'zero.png': it is a device; name a file"},
      {deform("s.off", "zero.yaml"), "cannot read 'zero.yaml': it is a device"},
      {{"animate", "--particles", "zero.csv", "--edit", "edit.yaml", "--out", "o.csv"},
       "cannot read 'zero.csv': it is a device"},
      {{"run", "zero.yaml"}, "cannot read 'zero.yaml': it is a device"},
      {deform("s.off", "."), "it is a folder"}};
  for (const auto& [arguments, says] : refusals) {
    const Ending ending = start(arguments);
    EXPECT_EQ(ending.status, 2) << says;
    EXPECT_THAT(ending.err, HasSubstr(says));
  }
}

TEST_F(SpecialFiles, AConfigMayComeFromAPipe) {
  put("c.yaml", kExperiment);
  const std::string line = "cat c.yaml | " DEFORMLAB_PROGRAM_PATH " run /dev/stdin --out out";
  const Ending ending = start_program(place(""), {"-c", line}, "/bin/bash");
  EXPECT_EQ(ending.status, 0) << ending.err;
  EXPECT_TRUE(exists("out/stdin/metrics.json"));
}

}  // namespace
}  // namespace deformlab::test
