#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/config.h"
#include "geometry/core/error.h"

// The weights and the options of energy terms in configs.
namespace deformlab {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Options {
  std::map<std::string, TermSettings> energies;
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("energies", o.energies, "terms");
  }
};

Options read(const std::string& yaml) {
  return read_config<Options>(
      parse_yaml(yaml, std::make_shared<const ConfigSource>(ConfigSource{"c.yaml", "folder"})));
}

TEST(TermSettings, ANumberIsTheWeight) {
  const Options o = read("energies: {rotation: 2}");
  EXPECT_EQ(o.energies.at("rotation").weight, 2);
  EXPECT_TRUE(o.energies.at("rotation").options.empty());
  EXPECT_EQ(to_yaml_line(to_node(o)), "{energies: {rotation: 2}}");
}

TEST(TermSettings, AMapHoldsTheWeightAndTheOptions) {
  const Options o = read("energies: {orientation: {weight: 3, least: 1}, rotation: {weight: 4}}");
  EXPECT_EQ(o.energies.at("orientation").weight, 3);
  EXPECT_EQ(std::get<double>(o.energies.at("orientation").options.at("least")), 1);
  EXPECT_EQ(o.energies.at("rotation").weight, 4);
  EXPECT_EQ(to_yaml_line(to_node(o)),
            "{energies: {orientation: {weight: 3, least: 1}, rotation: 4}}");
}

TEST(TermSettings, TheWeightMayBeLeftOut) {
  const Options o = read("energies: {orientation: {least: 0.2}}");
  EXPECT_FALSE(o.energies.at("orientation").weight.has_value());
}

TEST(TermSettings, WhatIsUnknownIsRefusedWithItsLine) {
  EXPECT_THAT([] { read("energies:\n  orientaton: 1"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("'orientaton'"), HasSubstr("line 2"))));
  EXPECT_THAT([] { read("energies:\n  orientation: {most: 1}"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("'most'"), HasSubstr("line 2"))));
  EXPECT_THAT([] { read("energies: {orientation: {least: low}}"); },
              ThrowsMessage<InputError>(HasSubstr("energies.orientation.least")));
}

TEST(TermSettings, HelpShowsTheOptions) {
  const std::vector<FieldHelp> help = describe<Options>();
  ASSERT_GE(help.size(), 2u);
  EXPECT_EQ(help[1].name, "energies.orientation.least");
  EXPECT_EQ(help[1].value, "0.1");
}

}  // namespace
}  // namespace deformlab
