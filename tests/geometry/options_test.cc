#include "geometry/core/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geometry/core/disjoint_sets.h"
#include "geometry/graph/deformation_graph.h"

namespace deformlab {
namespace {

using ::testing::ElementsAre;
using ::testing::ThrowsMessage;

TEST(EnumNames, GoBothWays) {
  EXPECT_EQ(name_of(NodeDistance::kEdgePaths), "edge_paths");
  EXPECT_EQ(value_of<NodeDistance>("edge_paths"), NodeDistance::kEdgePaths);
  EXPECT_EQ(value_of<NodeDistance>("edge-paths"), std::nullopt);
  EXPECT_EQ(name_of(static_cast<NodeDistance>(7)), "unnamed");
  EXPECT_THAT(all_names<EdgeWeights>(), ElementsAre("uniform", "overlap", "length"));
}

TEST(Range, SaysWhatItAllows) {
  EXPECT_EQ(Range().text(), "");
  EXPECT_EQ((Range{.min = 1, .max = 16}.text()), "1 to 16");
  EXPECT_EQ((Range{.min = 1e-6, .max = 100'000}.text()), "1e-06 to 100000");
  EXPECT_EQ((Range{.min = 0}.text()), "at least 0");
  EXPECT_EQ((Range{.max = 3.5}.text()), "at most 3.5");
  EXPECT_EQ((Range{.min = 0, .exclusive_min = true}.text()), "greater than 0");
  EXPECT_EQ((Range{.min = 0, .max = 1, .exclusive_min = true}.text()),
            "greater than 0 and at most 1");
}

TEST(Range, HoldsItsEndsUnlessTheyAreExcluded) {
  const Range closed{.min = 0, .max = 1};
  const Range open{.min = 0, .max = 1, .exclusive_min = true, .exclusive_max = true};
  for (const double end : {0.0, 1.0}) {
    EXPECT_TRUE(closed.contains(end));
    EXPECT_FALSE(open.contains(end));
  }
  EXPECT_TRUE(open.contains(0.5));
  EXPECT_FALSE(closed.contains(1.1));
  for (const double bad : {double(NAN), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_FALSE(Range().contains(bad)) << bad;
  }
}

TEST(Options, ErrorsNameTheFieldAndOwnersAddThePath) {
  GraphOptions options;
  options.neighbors = 17;
  EXPECT_THAT([&] { check_options(options); },
              ThrowsMessage<OptionError>("neighbors is 17; allowed: 1 to 16"));
  const auto inside = [&] {
    inside_option("deformer", [&] { inside_option("graph", [&] { check_options(options); }); });
  };
  EXPECT_THAT(inside,
              ThrowsMessage<OptionError>("deformer.graph.neighbors is 17; allowed: 1 to 16"));
  EXPECT_EQ(inside_option("graph", [] { return 3; }), 3);
}

TEST(DisjointSets, AreNumberedInTheOrderOfTheirFirstElements) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.join(5, 1));
  EXPECT_TRUE(sets.join(3, 5));
  EXPECT_FALSE(sets.join(1, 3));
  EXPECT_TRUE(sets.join(4, 2));
  EXPECT_EQ(sets.root(5), 1);
  EXPECT_EQ(sets.root(4), 2);
  EXPECT_THAT(sets.numbered(), ElementsAre(0, 1, 2, 1, 2, 1));
  EXPECT_TRUE(DisjointSets(0).numbered().empty());
}

}  // namespace
}  // namespace deformlab
