#include "geometry/core/text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace deformlab {
namespace {

TEST(Text, LinesSkipCommentsAndKnowWhereTheirWordsStand) {
  Lines lines("# one\n\n a  bc # d\r\ne\\\nf", true);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.name(), "line 3");
  ASSERT_EQ(lines.tokens().size(), 2u);
  EXPECT_EQ(lines.tokens()[1].text, "bc");
  EXPECT_EQ(lines.tokens()[1].at, 11u);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.tokens().size(), 2u) << "the backslash joins two lines";
  EXPECT_EQ(lines.number(), 4);
  EXPECT_FALSE(lines.next());
}

TEST(Text, NumbersAreWholeWords) {
  EXPECT_EQ(to_number("+.5"), 0.5);
  EXPECT_EQ(to_number("5."), 5);
  EXPECT_EQ(to_number("1e-400"), 0);
  EXPECT_TRUE(std::isinf(*to_number("1e400")));
  for (const char* word : {"", "+", "+-5", "1e", "0x10", "5a", "1,5"}) {
    EXPECT_FALSE(to_number(word)) << word;
  }
  EXPECT_EQ(to_float("0.1"), 0.1F);
  EXPECT_EQ(to_integer("+12"), 12);
  EXPECT_FALSE(to_integer("1.0"));
  EXPECT_FALSE(to_integer("99999999999999999999"));
}

TEST(Text, QuotesWhatCanBeShown) {
  EXPECT_EQ(quoted_ascii("a\n\xff!"),
            "'a?"
            "?!'");
  EXPECT_EQ(quoted_ascii(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace deformlab
