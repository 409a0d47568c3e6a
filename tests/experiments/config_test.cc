#include "experiments/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "experiments/config/override.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

enum class Method { kGaussNewton, kCeres };
constexpr auto names_of(Method) {
  using enum Method;
  return std::to_array<EnumName<Method>>({{kGaussNewton, "gauss_newton"}, {kCeres, "ceres"}});
}

struct Graph {
  int nodes = 300;
  std::uint64_t seed = 1;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("nodes", o.nodes, {.min = 1, .max = 1000}, "number of graph nodes");
    visit("seed", o.seed, "seed of the sampling");
  }
};

struct Claim {
  std::string name;
  double expected = 0;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("name", o.name, "measured quantity");
    visit("expected", o.expected, "its value");
  }
};

struct Options {
  std::filesystem::path shape;
  bool record = false;
  double tolerance = 1e-6;
  std::string title = "plain";
  std::string globalization = "none";
  Method method = Method::kGaussNewton;
  Eigen::Vector3d up = {0, 0, 1};
  std::vector<int> sizes = {1, 2};
  std::map<std::string, double> energies = {{"rotation", 1}, {"constraint", 100}};
  std::optional<double> length_unit = 0.5;
  Graph graph;
  std::map<std::string, Graph> parts;
  std::vector<Claim> claims;
  ConfigNode sweep;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.required("shape", o.shape, "file to deform");
    visit("record", o.record, "write every step");
    visit.range("tolerance", o.tolerance, {.min = 0, .exclusive_min = true}, "when to stop");
    visit("title", o.title, "title of the figure");
    visit.choice("globalization", o.globalization, {"none", "line_search"}, "step control");
    visit("method", o.method, "solver");
    visit("up", o.up, "upward direction");
    visit.range("sizes", o.sizes, {.min = 0}, "sizes");
    visit.range("energies", o.energies, {.min = 0}, "weights by name");
    visit.range("length_unit", o.length_unit, {.max = 10}, "unit of length [length]");
    visit("graph", o.graph, "deformation graph");
    visit("parts", o.parts, "graphs by name");
    visit("claims", o.claims, "what must show");
    visit("sweep", o.sweep, "runs to make");
  }
};

ConfigNode parse(const std::string& text) {
  return parse_yaml(text,
                    std::make_shared<const ConfigSource>(ConfigSource{"c.yaml", "folder", true}));
}

Options read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  ConfigNode root = parse(text);
  for (const std::string& change : overrides) apply_override(root, parse_override(change));
  return read_config<Options>(root);
}

/// The message of the InputError that reading the text gives, or "" where it gives none.
std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::error_of([&] { read(text, overrides); });
}

const char* const kFull = R"(shape: a b.off
record: true
tolerance: 1e-3
title: "12"   # quoted, so text
globalization: line_search
method: ceres
up: [0, 1, 0]
sizes: [5]
energies: {rotation: 2}
length_unit: ~
graph: {nodes: 425, seed: 18446744073709551615}
parts: {head: {nodes: 7}, tail: {seed: 2}}
claims:
  - name: "it's: \"rotated\"\n#1"
    expected: -0.1
  - name: ~x
sweep: {graph.nodes: [1, '2']}
)";

TEST(Config, ReadsEveryTypeOfField) {
  const Options o = read(kFull);
  EXPECT_EQ(o.shape, "a b.off");
  EXPECT_TRUE(o.record);
  EXPECT_EQ(o.tolerance, 1e-3);
  EXPECT_EQ(o.title, "12");
  EXPECT_EQ(o.globalization, "line_search");
  EXPECT_EQ(o.method, Method::kCeres);
  EXPECT_EQ(o.up, Eigen::Vector3d(0, 1, 0));
  EXPECT_THAT(o.sizes, ElementsAre(5));
  EXPECT_EQ(o.length_unit, std::nullopt);
  EXPECT_EQ(o.graph.nodes, 425);
  EXPECT_EQ(o.graph.seed, 18446744073709551615u);
  EXPECT_EQ(o.parts.at("head").nodes, 7);
  EXPECT_EQ(o.parts.at("tail").nodes, 300);
  ASSERT_EQ(o.claims.size(), 2u);
  EXPECT_EQ(o.claims[0].name, "it's: \"rotated\"\n#1");
  EXPECT_EQ(o.claims[0].expected, -0.1);
  EXPECT_EQ(o.sweep.kind, ConfigNode::Kind::kMap);
}

TEST(Config, MergesWeightsIntoTheDefaults) {
  const Options o = read("{shape: x, energies: {rotation: 2}}");
  EXPECT_THAT(o.energies, ElementsAre(std::pair("constraint", 100.0), std::pair("rotation", 2.0)));
}

TEST(Config, ResolvedConfigReadsBackTheSame) {
  for (const char* text : {kFull, "shape: ''"}) {
    const std::string resolved = to_yaml(to_node(read(text)));
    EXPECT_EQ(to_yaml(to_node(read(resolved))), resolved);
    EXPECT_THAT(resolved, HasSubstr("energies:\n  constraint: 100\n  rotation: "));
  }
  const Options again = read(to_yaml(to_node(read(kFull))));
  EXPECT_EQ(again.claims[0].name, "it's: \"rotated\"\n#1");
  EXPECT_EQ(again.claims[1].name, "~x");
  for (const std::string text : {"a\tb\r\n", "---", "...", "--- a"}) {
    EXPECT_EQ(parse(to_yaml(to_node(text))).text, text);
  }
  EXPECT_EQ(again.length_unit, std::nullopt);
  EXPECT_EQ(again.parts.size(), 2u);
  EXPECT_EQ(again.parts.at("tail").seed, 2u);
  EXPECT_EQ(again.method, Method::kCeres);
  EXPECT_TRUE(again.sweep.children[0].children[1].quoted);
}

TEST(Config, HelpComesFromTheSameDescription) {
  const std::string help = to_text(describe<Options>());
  EXPECT_THAT(help, HasSubstr("  shape              required"));
  EXPECT_THAT(help, HasSubstr("  tolerance          1e-06 "));
  EXPECT_THAT(help, HasSubstr("  graph.nodes        300 "));
  EXPECT_THAT(help, HasSubstr("  parts.NAME.nodes   300 "));
  EXPECT_THAT(help, HasSubstr("  claims[].name      required"));
  EXPECT_THAT(help, HasSubstr("step control: none | line_search\n"));
  EXPECT_THAT(help, HasSubstr("solver: gauss_newton | ceres\n"));
  EXPECT_THAT(help, HasSubstr("number of graph nodes; allowed: 1 to 1000\n"));
  EXPECT_THAT(help, HasSubstr("gauss_newton  "));
}

TEST(Config, UnknownKeyNamesLineKnownKeysAndNearest) {
  EXPECT_EQ(error_of("shape: x\ngraph:\n  nods: 3\n"),
            "unknown key 'nods' (line 3 of c.yaml); known: nodes, seed; did you mean 'nodes'?");
  EXPECT_EQ(error_of("shpae: x"), error_of("shpae: x\n"));
  EXPECT_THAT(error_of("shpae: x"), HasSubstr("did you mean 'shape'?"));
  EXPECT_THAT(error_of("shape: x\nqqqqqq: 3"), AllOf(HasSubstr("line 2"), Not(HasSubstr("mean"))));
}

TEST(Config, MissingRequiredKeyIsNamedWithItsMap) {
  EXPECT_EQ(error_of("record: true"), "missing key 'shape' (line 1 of c.yaml)");
  EXPECT_EQ(error_of("shape: x\nclaims:\n- expected: 1"),
            "missing key 'name' in 'claims[0]' (line 3 of c.yaml)");
}

TEST(Config, WrongTypesSayWhatIsThereAndWhatIsExpected) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"record: yes", "true or false", "'yes'"},
      {"record: 'true'", "true or false", "the quoted text 'true'"},
      {"tolerance: small", "a finite number", "'small'"},
      {"tolerance: '1'", "a finite number", "the quoted text '1'"},
      {"tolerance:", "a finite number", "nothing"},
      {"tolerance: .nan", "a finite number", "'.nan'"},
      {"tolerance: nan", "a finite number", "'nan'"},
      {"tolerance: inf", "a finite number", "'inf'"},
      {"tolerance: 1e999", "a finite number", "'1e999'"},
      {"tolerance: 1 2", "a finite number", "'1 2'"},
      {"title: [a]", "text", "a list of 1"},
      {"shape: {a: 1}", "a path", "a map"},
      {"up: [1, 2]", "a list of 3 numbers", "a list of 2"},
      {"up: 3", "a list of 3 numbers", "'3'"},
      {"sizes: 3", "a list", "'3'"},
      {"sizes: [1.5]", "a whole number from -2147483648 to 2147483647", "'1.5'"},
      {"sizes: [2147483648]", "a whole number from -2147483648", "'2147483648'"},
      {"energies: 3", "a map of keys", "'3'"},
      {"graph: 3", "a map of keys", "'3'"},
      {"graph: {nodes: 1e3}", "a whole number", "'1e3'"},
      {"graph: {seed: -1}", "a whole number from 0 to 18446744073709551615", "'-1'"},
      {"graph: {seed: 18446744073709551616}", "a whole number from 0", "'18446744073709551616'"},
  };
  for (const auto& [line, expected, found] : cases) {
    const std::string first = line.starts_with("shape") ? "" : "shape: x";
    EXPECT_THAT(error_of(first + "\n" + line),
                AllOf(HasSubstr("line 2 of c.yaml"), HasSubstr("expected " + expected),
                      HasSubstr("found " + found)))
        << line;
  }
  EXPECT_THAT(error_of("shape: x\nup: [1, 2, z]"), HasSubstr("'up[2]' (line 2 of c.yaml)"));
}

TEST(Config, ChoicesListWhatIsAllowed) {
  EXPECT_EQ(error_of("shape: x\nglobalization: linesearch"),
            "unknown value 'linesearch' for 'globalization' (line 2 of c.yaml); known: none, "
            "line_search; did you mean 'line_search'?");
  EXPECT_THAT(error_of("shape: x\nmethod: cere"), HasSubstr("did you mean 'ceres'?"));
}

TEST(Config, NumbersOutOfRangeNameKeyValueLineAndRange) {
  EXPECT_EQ(error_of("shape: x\ngraph:\n  nodes: 0\n"),
            "graph.nodes is 0 (line 3 of c.yaml); allowed: 1 to 1000");
  EXPECT_EQ(error_of("shape: x\ntolerance: 0"),
            "tolerance is 0 (line 2 of c.yaml); allowed: greater than 0");
  EXPECT_EQ(error_of("shape: x\nsizes:\n- 1\n- -1"),
            "sizes[1] is -1 (line 4 of c.yaml); allowed: at least 0");
  EXPECT_EQ(error_of("shape: x\nenergies:\n  rotation: -2"),
            "energies.rotation is -2 (line 3 of c.yaml); allowed: at least 0");
  EXPECT_EQ(error_of("shape: x\nparts: {head: {nodes: 5000}}"),
            "parts.head.nodes is 5000 (line 2 of c.yaml); allowed: 1 to 1000");
  EXPECT_EQ(error_of("shape: x\nlength_unit: 11"),
            "length_unit is 11 (line 2 of c.yaml); allowed: at most 10");
  EXPECT_EQ(error_of("shape: x", {"graph.nodes=-3"}),
            "graph.nodes is -3 (override 'graph.nodes=-3'); allowed: 1 to 1000");
}

TEST(Config, LinesAreAddedToErrorsOfCodeThatUsesTheOptions) {
  const ConfigNode root = parse("shape: x\ngraph:\n  nodes: 7");
  const auto fail = [&](const char* field) {
    with_lines_of(root, [&] {
      inside_option("graph",
                    [&] { throw OptionError(field, "7", ", but the shape has 5 vertices"); });
    });
  };
  EXPECT_THAT([&] { fail("nodes"); },
              ThrowsMessage<InputError>(
                  "graph.nodes is 7 (line 3 of c.yaml), but the shape has 5 vertices"));
  EXPECT_THAT(
      [&] { fail("seed"); },
      ThrowsMessage<InputError>("graph.seed is 7 (the default), but the shape has 5 vertices"));
}

TEST(Config, OptionsOfLibraryUsersAreCheckedByTheSameDescription) {
  Options options;
  options.parts["head"].nodes = 1001;
  EXPECT_THAT([&] { check_options(options); },
              ThrowsMessage<OptionError>("parts.head.nodes is 1001; allowed: 1 to 1000"));
  options = {};
  options.tolerance = NAN;
  EXPECT_THAT([&] { check_options(options); },
              ThrowsMessage<OptionError>("tolerance is nan; allowed: greater than 0"));
  options = {};
  options.globalization = "armijo";
  EXPECT_THAT([&] { check_options(options); },
              ThrowsMessage<OptionError>("globalization is 'armijo'; known: none, line_search"));
  EXPECT_NO_THROW(check_options(Options{}));
}

TEST(Config, NamesOfEarlierVersionsAreToldTheNewOnes) {
  EXPECT_EQ(known_names("separable_cg", {"auto", "kronecker_cg"}),
            "it is called 'kronecker_cg' now");
  EXPECT_EQ(known_names("arap", {"rbf", "cgal_arap"}), "it is called 'cgal_arap' now");
  EXPECT_EQ(known_names("rigid_shape", {"rbf", "arap_2d"}), "it is called 'arap_2d' now");
  EXPECT_EQ(known_names("adaptive", {"nodes"}, "graph."),
            "'graph.adaptive' is called 'adaptive' now");
  EXPECT_EQ(known_names("arap", {"mesh"}), "known: mesh");
}

TEST(Config, KeysOfOtherKindsAreCheckedTheSameWay) {
  const ConfigNode map = parse("rotation: 1\nrotaton: 2");
  EXPECT_THAT(
      [&] {
        check_keys(map, {"constraint", "rotation"}, "energy");
      },
      ThrowsMessage<InputError>("unknown energy 'rotaton' (line 2 of c.yaml); known: "
                                "constraint, rotation; did you mean 'rotation'?"));
}

TEST(Config, DuplicateKeysAreFoundAnywhereWithBothLines) {
  EXPECT_THAT(error_of("shape: x\nrecord: true\nshape: y"),
              HasSubstr("duplicate key 'shape' (line 1 and line 3 of c.yaml)"));
  EXPECT_THAT(error_of("shape: x\nsweep:\n- - a: 1\n    'a': 2"),
              HasSubstr("duplicate key 'a' (line 3 and line 4 of c.yaml)"));
}

TEST(Config, AliasesWorkAndMergeKeysAreRefused) {
  EXPECT_EQ(read("shape: &name x.off\ntitle: *name").title, "x.off");
  EXPECT_THAT(error_of("shape: x\ngraph: {<<: {nodes: 2}}"), HasSubstr("merge key '<<' (line 2"));
  EXPECT_THAT(error_of("shape: *nobody"), HasSubstr("line 1 of c.yaml"));
  EXPECT_THAT(error_of("shape: !include x"), HasSubstr("unknown tag '!include' (line 1"));
  EXPECT_THAT(error_of("[a, b]: 1"), HasSubstr("a key must be a name (line 1"));
}

TEST(Config, AliasBombsAndDeepNestingAreRefused) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 0; k < 9; ++k) bomb += ", " + last;
    bomb += "]\n";
  }
  EXPECT_THAT(error_of(bomb), HasSubstr("more than 1000000 values"));
  EXPECT_THAT(error_of("sweep: &a [*a]"), HasSubstr("nested deeper than 64 levels (line 1"));
  EXPECT_THAT(error_of(std::string(100, '[') + std::string(100, ']')), HasSubstr("nested deeper"));
  EXPECT_THAT(error_of(std::string(20'000, '[')), HasSubstr("levels (line 1 of c.yaml)"));
  EXPECT_THAT(error_of(std::string(20'000, '{')), HasSubstr("line 1 of c.yaml"));
  std::string dashes;
  for (int i = 0; i < 5'000; ++i) dashes += "- ";
  EXPECT_THAT(error_of(dashes), HasSubstr("line 1 of c.yaml"));
}

TEST(Override, SetsValuesAndMakesMaps) {
  const std::string text = "shape: x\nclaims:\n- name: a\n- name: b\nlength_unit: 3";
  const Options o = read(text, {"graph.nodes=425", "claims.1.name=c", "up=[1, 0, 0]", "shape=a=b",
                                "energies.rotation=7", "length_unit=", "graph.nodes=426"});
  EXPECT_EQ(o.graph.nodes, 426);
  EXPECT_EQ(o.graph.seed, 1u);
  EXPECT_EQ(o.claims[1].name, "c");
  EXPECT_EQ(o.up, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(o.shape, "a=b");
  EXPECT_EQ(o.energies.at("constraint"), 100);
  EXPECT_EQ(o.energies.at("rotation"), 7);
  EXPECT_EQ(o.length_unit, std::nullopt);
}

TEST(Override, IsNamedWhereItsKeyOrValueIsWrong) {
  EXPECT_EQ(error_of("shape: x\ngraph:", {"graph.nods=3"}),
            "unknown key 'nods' (override 'graph.nods=3'); known: nodes, seed; did you mean "
            "'nodes'?");
  EXPECT_THAT(error_of("shape: x", {"grph.nodes=3"}),
              HasSubstr("unknown key 'grph' (override 'grph.nodes=3')"));
  EXPECT_THAT(error_of("shape: x", {"graph.nodes=many"}),
              HasSubstr("'graph.nodes' (override 'graph.nodes=many'): expected a whole number"));
  EXPECT_THAT(error_of("shape: x", {"up=[1"}), HasSubstr("not valid YAML (override 'up=[1')"));
  EXPECT_THAT(error_of("shape: x", {"graph={seed: 1, seed: 2}"}),
              HasSubstr("duplicate key 'seed' (override 'graph={seed: 1, seed: 2}')"));
  EXPECT_THAT(error_of("shape: x\nsizes: [1]", {"sizes.1=3"}),
              AllOf(HasSubstr("override 'sizes.1=3': no element '1'"), HasSubstr("line 2")));
  EXPECT_THAT(error_of("shape: x", {"shape.y=3"}),
              HasSubstr("override 'shape.y=3' looks for 'y' inside 'x' (line 1 of c.yaml)"));
}

}  // namespace
}  // namespace deformlab
