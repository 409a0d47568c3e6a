// What holds for the options of every struct that a config can set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>

#include "experiments/config/config.h"
#include "experiments/subjects/animation/script.h"
#include "experiments/subjects/experiment.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {
namespace {

std::vector<FieldHelp> all_fields() {
  std::vector<FieldHelp> fields = describe<ExperimentConfig>();
  for (const auto& more : {describe<EditEntry>(), describe<KeyframesOptions>()}) {
    fields.insert(fields.end(), more.begin(), more.end());
  }
  return fields;
}

TEST(AllOptions, DefaultsAreAllowed) {
  EXPECT_NO_THROW(check_options(ExperimentConfig{}));
  EXPECT_NO_THROW(check_options(EditEntry{}));
}

TEST(AllOptions, AreDescribedByPhrases) {
  for (const FieldHelp& field : all_fields()) {
    const bool is_literal = field.meaning.starts_with("true ");
    EXPECT_TRUE(is_literal || std::isupper(static_cast<unsigned char>(field.meaning[0])) ||
                std::isdigit(static_cast<unsigned char>(field.meaning[0])))
        << field.name << ": " << field.meaning;
    EXPECT_GE(field.meaning.size(), 9u) << field.name << ": " << field.meaning;
  }
}

TEST(AllOptions, HaveUnitsOfOneList) {
  const std::set<std::string> known{"[length]", "[length_unit]", "[degree]", "[frame]",
                                    "[pixel]",  "[pixel²]",      "[MB]",     "[pixel/length]"};
  const std::set<std::string> coordinates{"[x, y]", "[x, y, z]", "[dx, dy, dz]",
                                          "[x0, y0, x1, y1]"};
  const std::regex bracket(R"(\[[^\]]*\])");
  for (const FieldHelp& field : all_fields()) {
    for (std::sregex_iterator it(field.meaning.begin(), field.meaning.end(), bracket), end;
         it != end; ++it) {
      EXPECT_TRUE(known.contains(it->str()) || coordinates.contains(it->str()))
          << field.name << ": " << field.meaning;
    }
  }
}

}  // namespace
}  // namespace deformlab
