#include "tests/fuzz/readers.h"

#include <gtest/gtest.h>

#include <ostream>
#include <random>

#include "geometry/core/error.h"

namespace deformlab::fuzz {

void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

namespace {

/// Each reader with its samples, without a fuzzer.
class Readers : public ::testing::TestWithParam<Reader> {};

std::string name_of_reader(const ::testing::TestParamInfo<Reader>& info) { return info.param.name; }

TEST_P(Readers, ReadTheirSamples) {
  const Texts samples = GetParam().samples();
  ASSERT_FALSE(samples.empty());
  EXPECT_FALSE(GetParam().words().empty());  // libFuzzer takes no empty dictionary
  for (const std::string& sample : samples) EXPECT_NO_THROW(GetParam().read(sample)) << sample;
}

/// The sample with a few bytes changed, removed, or repeated.
std::string damaged(std::string bytes, std::mt19937& random) {
  for (auto left = 1 + random() % 3; left > 0 && !bytes.empty(); --left) {
    const std::size_t at = random() % bytes.size(), size = 1 + random() % 8;
    switch (random() % 3) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, size);
        break;
      default:
        bytes.insert(random() % bytes.size(), bytes.substr(at, size));
    }
  }
  return bytes;
}

TEST_P(Readers, RefuseDamagedSamplesOrReadThem) {
  std::mt19937 random(1);
  for (const std::string& sample : GetParam().samples()) {
    for (int i = 0; i < 40; ++i) {
      const std::string bytes = damaged(sample, random);
      try {
        GetParam().read(bytes);
      } catch (const InputError& error) {
        EXPECT_STRNE(error.what(), "");
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what() << " for " << ::testing::PrintToString(bytes);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Readers, ::testing::ValuesIn(readers()), name_of_reader);

}  // namespace
}  // namespace deformlab::fuzz
