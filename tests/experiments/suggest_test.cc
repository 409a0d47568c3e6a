#include "experiments/config/suggest.h"

#include <gtest/gtest.h>

namespace deformlab {
namespace {

TEST(Suggest, CountsEditsAndNamesTheNearest) {
  EXPECT_EQ(edit_distance("rotaton", "rotation"), 1);
  EXPECT_EQ(edit_distance("shpae", "shape"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("Nodes", "nodes"), 0);
  EXPECT_EQ(nearest_name("neighbours", {"nodes", "neighbors"}), "neighbors");
  EXPECT_EQ(nearest_name("colour", {"nodes", "seed"}), std::nullopt);
  EXPECT_EQ(nearest_name("x", {}), std::nullopt);
  EXPECT_EQ(known_names("x", {}), "known: none");
  EXPECT_EQ(quote("a\nb"), "'a?b'");
  EXPECT_EQ(quote(std::string(1000, 'a')), "'" + std::string(60, 'a') + "…'");
}

}  // namespace
}  // namespace deformlab
