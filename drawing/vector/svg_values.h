#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// The name of an element without the prefix of its namespace.
std::string_view local_name(std::string_view name);

// Readers of attributes in the form in which Cairo's SVG surface writes them.

/// All numbers of a text with any separators: `matrix(1,0,0,1,5,6)`, `50%`, `3,4`.
std::vector<double> numbers(std::string_view text);

/// The values of `stroke:none;fill-rule:nonzero;…` by their names.
std::map<std::string_view, std::string_view> style_of(std::string_view text);

/// The map of `matrix(a,b,c,d,e,f)`, or the identity for an empty text.
Eigen::Affine2d matrix_of(std::string_view text);

/// The curves of `M x y L x y C … Z`, mapped. Curves of a single point are left out.
std::vector<Curve> curves_of(std::string_view text, const Eigen::Affine2d& map);

}  // namespace deformlab
