// What holds for the options of every struct that a config can set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>

#include "experiments/config/config.h"
#include "experiments/subjects/experiment.h"
#include "experiments/subjects/motion/script.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/shape/edit.h"
#include "render/camera.h"

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
  const std::set<std::string> known{"[length]", "[length_unit]",  "[degree]",
                                    "[frame]",  "[pixel]",        "[pixel²]",
                                    "[MB]",     "[pixel/length]", "[s]"};
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

TEST(PictureOptions, TheCameraLooksFromAboveWhicheverAxisIsUp) {
  Eigen::Matrix3Xd pyramid(3, 5);
  pyramid << 0, 1, 0, 1, 0.5, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0.5;  // its top is at y = 1
  PictureOptions options;
  Camera camera = camera_for(options, pyramid);
  EXPECT_EQ(camera.up, Eigen::Vector3d(0, 1, 0));
  EXPECT_LT((camera.direction - Eigen::Vector3d(0.5, -0.6, -1)).norm(), 1e-12);
  EXPECT_EQ(camera_for(options, Eigen::Matrix3Xd(3, 0)), Camera()) << "z is up by default";
  options.up = Eigen::Vector3d(0, 0, 1);
  EXPECT_EQ(camera_for(options, pyramid), Camera());
  options.up.reset();
  options.direction = Eigen::Vector3d(1, 0, 0);
  camera = camera_for(options, pyramid);
  EXPECT_EQ(camera.direction, *options.direction);
  EXPECT_EQ(camera.up, Camera().up) << "as ever where a direction is given";
}

}  // namespace
}  // namespace deformlab
