#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "geometry/shape/shape_io.h"
#include "tests/support/errors.h"

namespace deformlab {

/// A file in a folder of the running test's own.
inline std::filesystem::path place(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                       (std::string(test->test_suite_name()) + "." + test->name());
  std::filesystem::create_directories(folder);
  return folder / name;
}

inline std::filesystem::path put(const std::string& name, const std::string& bytes) {
  std::filesystem::path path = place(name);
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::string get(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What read_shape says about a file of these bytes; empty where it reads them.
inline std::string reading(const std::string& name, const std::string& bytes) {
  return test::error_of([&] { read_shape(put(name, bytes)); });
}

/// The bytes of a number, in the machine's order or the other one.
template <class T>
std::string raw(T value, bool swapped = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace deformlab
