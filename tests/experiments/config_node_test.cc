#include "experiments/config/config_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::filesystem::path write(const std::string& name, const std::string& text) {
  std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string load_error(const std::filesystem::path& path) {
  return test::error_of([&] { load_config(path); });
}

TEST(Config, UnusableFilesAreNamed) {
  const std::filesystem::path folder = ::testing::TempDir();
  EXPECT_THAT(load_error(folder / "nothing.yaml"), HasSubstr("nothing.yaml': no such file"));
  EXPECT_THAT(load_error(folder), HasSubstr("it is a folder"));
  EXPECT_THAT(load_error(write("empty.yaml", "")), HasSubstr("empty.yaml' is empty"));
  EXPECT_THAT(load_error(write("comment.yaml", "# only\n")), HasSubstr("is empty"));
  EXPECT_THAT(load_error(write("list.yaml", "\n- 1\n")),
              AllOf(HasSubstr("line 2 of"), HasSubstr("must be a map"), HasSubstr("a list of 1")));
  EXPECT_THAT(load_error(write("broken.yaml", "a: 1\nb: [1, 2\nc: 3\n")),
              AllOf(HasSubstr("not valid YAML (line 3 of"), HasSubstr("broken.yaml")));
  EXPECT_THAT(load_error(write("two.yaml", "a: 1\n---\nb: 2\n")),
              HasSubstr("a second YAML document"));
  EXPECT_THAT(load_error(write("comma.yaml", ",a: 1\n")), HasSubstr("stray sign"));
  EXPECT_THAT(load_error(write("bracket.yaml", "a: 1\n]\n")), HasSubstr("bracket.yaml"));
  EXPECT_THAT(load_error(write("cut.yaml", "a: \"b")), HasSubstr("line 1 of"));
  EXPECT_NE(load_error(write("binary.yaml", std::string("\0\1\xff\x7f: \x89PNG", 10))), "");
  const ConfigNode good = load_config(write("good.yaml", "a: 1\r\nb: 2\r\n"));
  EXPECT_EQ(good.find("b")->text, "2");
  EXPECT_EQ(good.find("b")->line, 2);
  EXPECT_EQ(good.folder(), (folder / "x").parent_path());
}

}  // namespace
}  // namespace deformlab
