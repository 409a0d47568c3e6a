#pragma once

#include <polyclipping/clipper.hpp>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// What lies in a region, which is given by the polygons of Clipper (non-zero winding) in `scale`
/// units of length [1/length]. Curves stay curves between the places where they are cut. A share of
/// an area or a length that is not above `nothing` counts as nothing.
class Clipped {
 public:
  Clipped(ClipperLib::Paths region, double scale, double nothing = 1e-6)
      : region_(std::move(region)), scale_(scale), nothing_(nothing) {}

  /// The part of what is inside the outlines. It is `outlines` itself if nothing lies outside.
  Outlines inside(const Outlines& outlines) const;

  /// A part of a curve, and where it begins along the curve [length].
  struct Piece {
    Curve curve;
    double begin;
  };
  /// The parts of the curve in its own direction. It is the curve itself if nothing lies outside.
  std::vector<Piece> along(const Curve& curve) const;

 private:
  ClipperLib::Paths region_;
  double scale_, nothing_;
};

/// What lies inside of an outline.
Clipped region_of(const Outlines& outlines, double scale);

/// What lies inside of both outlines. It is the first one itself if it lies in the second one.
Outlines common(const Outlines& outlines, const Outlines& clip, double scale);

}  // namespace deformlab
