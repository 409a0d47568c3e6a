#include "render/color.h"

#include <algorithm>
#include <cmath>

namespace deformlab {

Eigen::Vector3f to_linear(const Color& color) {
  const auto decode = [](double s) {
    s = std::clamp(s, 0.0, 1.0);
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  };
  return color.unaryExpr([&](double s) { return double{decode(s)}; }).cast<float>();
}

void store(const Eigen::Vector3f& linear, std::uint8_t* rgb) {
  for (int c = 0; c < 3; ++c) {
    const float l = std::clamp(linear(c), 0.0F, 1.0F);
    const float s = l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1 / 2.4F) - 0.055F;
    rgb[c] = static_cast<std::uint8_t>(std::lround(255 * s));
  }
}

}  // namespace deformlab
