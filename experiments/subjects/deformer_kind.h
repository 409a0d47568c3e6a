#pragma once

#include <array>

#include "geometry/core/enum_names.h"

namespace deformlab {

/// The method that deforms. auto is embedded_deformation for a shape and arap_2d for a drawing.
enum class DeformerKind { kAuto, kEmbeddedDeformation, kArap2d, kRbf, kPrimo, kCgalArap };
constexpr auto names_of(DeformerKind) {
  using enum DeformerKind;
  return std::to_array<EnumName<DeformerKind>>({{kAuto, "auto"},
                                                {kEmbeddedDeformation, "embedded_deformation"},
                                                {kArap2d, "arap_2d"},
                                                {kRbf, "rbf"},
                                                {kPrimo, "primo"},
                                                {kCgalArap, "cgal_arap"}});
}

}  // namespace deformlab
