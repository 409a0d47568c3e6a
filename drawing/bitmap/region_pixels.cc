#include "drawing/bitmap/region_pixels.h"

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

/// Adds to each row the x at which the polygon's edges cross the line through the row's centre.
void add_crossings(const Eigen::Matrix2Xd& polygon, std::vector<std::vector<double>>& rows) {
  const double last = static_cast<double>(rows.size()) - 1;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    if (a.y() > b.y()) std::swap(a, b);
    const double from = std::max(0.0, std::ceil(a.y() - 0.5));
    const double to = std::min(last, std::ceil(b.y() - 0.5) - 1);
    for (double y = from; y <= to; ++y) {
      const double t = (y + 0.5 - a.y()) / (b.y() - a.y());
      rows[static_cast<std::size_t>(y)].push_back(a.x() + t * (b.x() - a.x()));
    }
  }
}

/// What a pixel belongs to.
enum class Owner : std::uint8_t { kNobody, kRegion, kOther };

struct Pixel {
  int x, y;
};

/// Finds the owners of the pixels in the region, and of those outside that are opaque enough to
/// belong to another part. Collects both in `pixels`.
std::vector<Owner> decided(const Region& region, double threshold, const Bitmap& bitmap,
                           std::vector<Pixel>& pixels) {
  std::vector<Owner> owners(bitmap.rgba.size() / 4, Owner::kNobody);
  const auto at = [&](int x, int y) -> Owner& {
    return owners[static_cast<std::size_t>(bitmap.pixel(x, y) - bitmap.rgba.data()) / 4];
  };
  for_each_pixel_inside(region, bitmap.width, bitmap.height,
                        [&](int x, int y) { at(x, y) = Owner::kRegion; });
  for (int y = 0; y < bitmap.height; ++y)
    for (int x = 0; x < bitmap.width; ++x) {
      const bool opaque = bitmap.pixel(x, y)[3] >= 255 * threshold;
      if (at(x, y) == Owner::kNobody && opaque) at(x, y) = Owner::kOther;
      if (at(x, y) != Owner::kNobody) pixels.push_back({x, y});
    }
  return owners;
}

}  // namespace

void for_each_pixel_inside(const Region& region, int width, int height,
                           const std::function<void(int x, int y)>& visit) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(height));
  add_crossings(region.outline, rows);
  for (const Eigen::Matrix2Xd& hole : region.holes) add_crossings(hole, rows);
  for (int y = 0; y < height; ++y) {
    std::vector<double>& row = rows[static_cast<std::size_t>(y)];
    std::ranges::sort(row);
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
      const int from = static_cast<int>(std::max(0.0, std::ceil(row[i] - 0.5)));
      const int to = static_cast<int>(std::min<double>(width, std::ceil(row[i + 1] - 0.5)));
      for (int x = from; x < to; ++x) visit(x, y);
    }
  }
}

void clear_outside(const Region& region, double threshold, Bitmap& bitmap) {
  std::vector<Pixel> front, next;
  std::vector<Owner> owners = decided(region, threshold, bitmap, front);
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(bitmap.width) +
           static_cast<std::size_t>(x);
  };
  while (!front.empty()) {  // reaches fainter pixels in the order of their distance
    next.clear();
    for (const auto [x, y] : front)
      for (int v = std::max(0, y - 1); v <= std::min(bitmap.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(bitmap.width - 1, x + 1); ++u) {
          Owner& owner = owners[index(u, v)];
          if (owner != Owner::kNobody || bitmap.pixel(u, v)[3] == 0) continue;
          owner = owners[index(x, y)];
          next.push_back({u, v});
        }
    front.swap(next);
  }
  for (std::size_t i = 0; i < owners.size(); ++i)
    if (owners[i] != Owner::kRegion)
      std::fill_n(bitmap.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(i), 4, std::uint8_t{0});
}

}  // namespace deformlab
