#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "drawing/bitmap/bitmap.h"
#include "geometry/core/error.h"
#include "geometry/plane/triangulation.h"
#include "tests/support/errors.h"

namespace deformlab::test {

/// A test with an empty folder of its own.
class FolderTest : public ::testing::Test {
 protected:
  FolderTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("deformlab_") + test->test_suite_name() + "." + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path place(const std::string& name) const { return folder_ / name; }

  std::filesystem::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(place(name), std::ios::binary) << bytes;
    return place(name);
  }

  std::string get(const std::string& name) const {
    std::ifstream in(place(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::filesystem::path folder_;
};

/// What an InputError says; empty where nothing is thrown.
inline std::string refusal(const std::function<void()>& action) {
  return test::error_of([&] { action(); });
}

/// A disc of changing colours with a rim one pixel wide, on transparent ground.
inline Bitmap disc(int width, int height, const Eigen::Vector2d& center, double radius) {
  Bitmap bitmap(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double inside = radius - (Eigen::Vector2d(x + 0.5, y + 0.5) - center).norm();
      const double alpha = std::clamp(inside + 0.5, 0.0, 1.0);
      std::uint8_t* p = bitmap.pixel(x, y);
      p[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
      if (p[3] == 0) continue;
      p[0] = static_cast<std::uint8_t>(5 * x % 256);
      p[1] = static_cast<std::uint8_t>(7 * y % 256);
      p[2] = static_cast<std::uint8_t>((x + 3 * y) % 256);
    }
  return bitmap;
}

/// A grid of n×n vertices over the box from `a` to `b`, squares cut in two.
inline Triangulation grid_mesh(int n, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Triangulation mesh{Eigen::Matrix2Xd(2, n * n), Eigen::Matrix3Xi(3, 2 * (n - 1) * (n - 1))};
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    mesh.V.col(i) = a + (b - a).cwiseProduct(Eigen::Vector2d(column, row) / (n - 1));
  }
  int f = 0;
  for (int y = 0; y + 1 < n; ++y)
    for (int x = 0; x + 1 < n; ++x) {
      const int v = y * n + x;
      mesh.F.col(f++) << v, v + 1, v + n + 1;
      mesh.F.col(f++) << v, v + n + 1, v + n;
    }
  return mesh;
}

/// Mean difference of premultiplied channels, 0 … 255, of bitmaps of one size.
inline double mean_difference(const Bitmap& a, const Bitmap& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  if (a.rgba.size() != b.rgba.size()) return 255;
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const std::size_t alpha = i | 3;
    const auto value = [&](const Bitmap& m) {
      return i == alpha ? m.rgba[i] : m.rgba[i] * m.rgba[alpha] / 255.0;
    };
    sum += std::abs(value(a) - value(b));
  }
  return sum / static_cast<double>(a.rgba.size());
}

}  // namespace deformlab::test
