#include "experiments/config/override.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/core/error.h"
#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

ConfigNode parse(const std::string& text) {
  return parse_yaml(text,
                    std::make_shared<const ConfigSource>(ConfigSource{"c.yaml", "folder", true}));
}

TEST(Override, MalformedOnesAreRefused) {
  for (const char* text : {"=3", "nodes", ""}) {
    EXPECT_THAT([&] { parse_override(text); },
                ThrowsMessage<InputError>(HasSubstr("must have the form key=value")))
        << text;
  }
  for (const char* text : {"a..b=1", ".a=1", "a.=1", ".=1"}) {
    EXPECT_THAT([&] { parse_override(text); },
                ThrowsMessage<InputError>(HasSubstr("has an empty name in its key")))
        << text;
  }
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  EXPECT_THAT([&] { parse_override(deep + "=1"); },
              ThrowsMessage<InputError>(HasSubstr("more than 64 names")));
}

std::vector<std::string> texts(const std::vector<SweptRun>& runs) {
  std::vector<std::string> all;
  for (const SweptRun& run : runs) {
    std::string text;
    for (const Override& change : run.overrides) text += change.text() + ";";
    all.push_back(text);
  }
  return all;
}

TEST(Sweep, IsTheCartesianProductInFileOrder) {
  const ConfigNode sweep = parse("{b.c: [1, 'x: y'], a: [[0, 0, 1], {k: ~}, null]}");
  EXPECT_THAT(texts(expand_sweep(sweep)),
              ElementsAre("b.c=1;a=[0, 0, 1];", "b.c=1;a.k=~;", "b.c=1;a=~;",
                          "b.c=\"x: y\";a=[0, 0, 1];", "b.c=\"x: y\";a.k=~;", "b.c=\"x: y\";a=~;"));
  EXPECT_EQ(expand_sweep(sweep)[0].overrides[0].folder, "folder");
  EXPECT_THAT(texts(expand_sweep(ConfigNode{})), ElementsAre(""));
}

TEST(Sweep, NamedMapsSetTheirKeysTogether) {
  const ConfigNode sweep =
      parse("{row: {small: {a.b: 1, edit: [2]}, large: {a: {c: 3}}}, k: [4, 5]}");
  const std::vector<SweptRun> runs = expand_sweep(sweep);
  EXPECT_THAT(texts(runs), ElementsAre("a.b=1;edit=[2];k=4;", "a.b=1;edit=[2];k=5;", "a.c=3;k=4;",
                                       "a.c=3;k=5;"));
  using Settings = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(runs[1].settings, (Settings{{"row", "small"}, {"k", "5"}}));
  std::vector<std::string> keys;
  for (const ConfigNode* key : swept_keys(sweep)) keys.push_back(key->key);
  EXPECT_THAT(keys, ElementsAre("a.b", "edit", "a", "k"));
}

TEST(Sweep, RefusesWhatIsNoSweep) {
  const auto error = [](const std::string& text) -> std::string {
    return test::error_of([&] { expand_sweep(parse(text)); });
  };
  EXPECT_THAT(error("a: [1]\nb: []"), HasSubstr("sweep over 'b' (line 2 of c.yaml) needs a list"));
  EXPECT_THAT(error("a: 3"), HasSubstr("found '3'"));
  EXPECT_THAT(error("row: {}"), HasSubstr("or maps of keys by their names"));
  EXPECT_THAT(error("row: {one: 3}"), HasSubstr("'one' (line 1 of c.yaml) must map keys"));
  EXPECT_THAT(error("row: {one: {}}"), HasSubstr("'one' (line 1 of c.yaml) must map keys"));
  EXPECT_THAT(error("[1]"), HasSubstr("'sweep' must map dotted keys to lists (line 1"));
  EXPECT_THAT(error("a..b: [1]"), HasSubstr("empty name"));
  std::string hundred = "[0";
  for (int i = 1; i < 100; ++i) hundred += ", " + std::to_string(i);
  const std::string allowed = "a: " + hundred + "]\nb: " + hundred + "]\n";
  EXPECT_EQ(expand_sweep(parse(allowed)).size(), kMaxSweepRuns);
  EXPECT_THAT(error(allowed + "c: [1, 2]"),
              AllOf(HasSubstr("more than 10000 runs"), HasSubstr("line 3")));
}

}  // namespace
}  // namespace deformlab
