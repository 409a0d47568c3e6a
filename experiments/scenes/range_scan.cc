#include "experiments/scenes/range_scan.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "geometry/core/error.h"
#include "render/ray_scene.h"

namespace deformlab {
namespace {

constexpr float kJump = 4;  // a larger difference in depth [distance of rays] is a silhouette
constexpr double kLargestHole = 0.06;  // radius, as a part of the image

// The i-th of n directions that are spread evenly over the sphere, on a spiral.
Eigen::Vector3f direction(int i, int n) {
  const double z = 1 - (2 * i + 1.0) / n, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z).cast<float>();
}

// One depth image, in the coordinates of the unit sphere around the shape.
class Image {
 public:
  Image(const RayScene& scene, const Eigen::Vector3f& toward, const RangeScanOptions& options,
        std::mt19937_64& random)
      : n_(options.resolution), spacing_(2.0F / n_), options_(options), random_(random) {
    rotation_.setFromTwoVectors(Eigen::Vector3f::UnitZ(), toward);
    depth_.setConstant(n_, n_, NAN);
    for (int y = 0; y < n_; ++y) {
      for (int x = 0; x < n_; ++x) {
        const auto hit = scene.first_hit(rotation_ * at(x, y, 1), -toward);
        if (hit) depth_(x, y) = 1 - hit->distance;
      }
    }
    for (int i = 0; i < options.holes; ++i) punch_hole();
    std::normal_distribution<float> noise(0, static_cast<float>(options.noise) * spacing_);
    for (float& depth : depth_.reshaped()) depth += noise(random_);
  }

  /// Appends the vertices and triangles of the image.
  void add_to(std::vector<Eigen::Vector3f>& V, std::vector<std::vector<int>>& faces) {
    Eigen::ArrayXXi vertex = Eigen::ArrayXXi::Constant(n_, n_, -1);
    const auto use = [&](int x, int y) {
      if (vertex(x, y) < 0) {
        vertex(x, y) = static_cast<int>(V.size());
        V.push_back(rotation_ * at(x, y, depth_(x, y)));
      }
      return vertex(x, y);
    };
    for (int y = 0; y + 1 < n_; ++y) {
      for (int x = 0; x + 1 < n_; ++x) {
        if (joined({{x, y}, {x + 1, y}, {x + 1, y + 1}})) {
          faces.push_back({use(x, y), use(x + 1, y), use(x + 1, y + 1)});
        }
        if (joined({{x, y}, {x + 1, y + 1}, {x, y + 1}})) {
          faces.push_back({use(x, y), use(x + 1, y + 1), use(x, y + 1)});
        }
      }
    }
    for (int i = 0; i < options_.outliers; ++i) add_outlier(V, faces);
  }

 private:
  struct Pixel {
    int x, y;
  };

  Eigen::Vector3f at(float x, float y, float depth) const {
    return {(x + 0.5F) * spacing_ - 1, (y + 0.5F) * spacing_ - 1, depth};
  }

  Pixel some_pixel() {
    std::uniform_int_distribution<int> any(0, n_ - 2);
    const int x = any(random_), y = any(random_);
    return {x, y};
  }

  void punch_hole() {
    const Pixel center = some_pixel();
    const double radius = kLargestHole * n_ * std::uniform_real_distribution<>()(random_);
    for (int y = 0; y < n_; ++y) {
      for (int x = 0; x < n_; ++x) {
        if (std::hypot(x - center.x, y - center.y) < radius) depth_(x, y) = NAN;
      }
    }
  }

  bool joined(std::initializer_list<Pixel> corners) const {
    float low = 2, high = -2;
    for (const auto [x, y] : corners) {
      if (std::isnan(depth_(x, y))) return false;
      low = std::min(low, depth_(x, y));
      high = std::max(high, depth_(x, y));
    }
    return high - low < kJump * spacing_;
  }

  void add_outlier(std::vector<Eigen::Vector3f>& V, std::vector<std::vector<int>>& faces) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const auto [x, y] = some_pixel();
      if (std::isnan(depth_(x, y))) continue;
      const float off = 8 * spacing_ * std::uniform_real_distribution<float>()(random_);
      const int first = static_cast<int>(V.size());
      for (const auto [dx, dy] : {Pixel{0, 0}, {1, 0}, {0, 1}}) {
        V.push_back(rotation_ * at(x + dx, y + dy, depth_(x, y) + spacing_ + off));
      }
      faces.push_back({first, first + 1, first + 2});
      return;
    }
  }

  int n_;
  float spacing_;
  const RangeScanOptions& options_;
  std::mt19937_64& random_;
  Eigen::Quaternionf rotation_;
  Eigen::ArrayXXf depth_;  // toward the eye; NaN if a ray hits nothing
};

}  // namespace

Shape range_scan(const Shape& shape, const RangeScanOptions& options) {
  check_options(options);
  check_number("views", options.views, {.min = 1});
  const Eigen::Vector3d low = shape.V.rowwise().minCoeff(), high = shape.V.rowwise().maxCoeff();
  const Eigen::Vector3d center = (low + high) / 2;
  const double radius = (high - low).norm() / 2;
  RayScene scene;
  scene.add_triangles(((shape.V.colwise() - center) / radius).cast<float>(), triangles(shape));
  scene.commit();
  std::mt19937_64 random(options.seed);
  std::vector<Eigen::Vector3f> V;
  Shape scan;
  for (int i = 0; i < options.views; ++i) {
    Image(scene, direction(i, options.views), options, random).add_to(V, scan.faces);
  }
  if (V.empty()) throw InputError("shape.scan: no ray meets the shape; it needs faces");
  scan.V.resize(3, static_cast<Eigen::Index>(V.size()));
  scan.N.resize(3, 0);
  for (Eigen::Index i = 0; i < scan.V.cols(); ++i) {
    scan.V.col(i) = center + radius * V[static_cast<std::size_t>(i)].cast<double>();
  }
  return scan;
}

}  // namespace deformlab
