#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace deformlab {

using Color = Eigen::Vector3d;  ///< sRGB, each in 0..1

namespace colors {
inline const Color kSurface{0.87, 0.84, 0.805};
inline const Color kFixed{0.50, 0.78, 0.53};   ///< pinned vertices
inline const Color kHandle{1.00, 0.80, 0.10};  ///< positions of handles
inline const Color kTarget{0.90, 0.30, 0.20};  ///< targets of handles
inline const Color kNode{0.16, 0.36, 0.66};
inline const Color kEdge{0.30, 0.45, 0.68};
}  // namespace colors

/// The colour in linear light, where colours can be scaled and averaged.
Eigen::Vector3f to_linear(const Color& color);

/// Writes three bytes of sRGB; values outside 0..1 are clamped.
void store(const Eigen::Vector3f& linear, std::uint8_t* rgb);

}  // namespace deformlab
