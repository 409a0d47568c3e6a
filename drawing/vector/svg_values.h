#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "drawing/vector/vector_path.h"

namespace deformlab {

// Attributes as Cairo's SVG surface writes them.

/// All numbers of a text, whatever stands between them: `matrix(1,0,0,1,5,6)`, `50%`, `3,4`.
std::vector<double> numbers(std::string_view text);

/// `stroke:none;fill-rule:nonzero;…` by name.
std::map<std::string_view, std::string_view> style_of(std::string_view text);

/// `matrix(a,b,c,d,e,f)`; the identity where there is none.
Eigen::Affine2d matrix_of(std::string_view text);

/// `M x y L x y C … Z` of straight lines and cubics, mapped. Lone points are left out.
std::vector<Curve> curves_of(std::string_view text, const Eigen::Affine2d& map);

}  // namespace deformlab
