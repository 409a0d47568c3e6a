#include <cmath>
#include <cstdlib>

#include "geometry/shape.h"

int main() {
  deformlab::Shape shape;
  shape.V.resize(3, 2);
  shape.V << 0, 3, 0, 4, 0, 0;
  return std::abs(deformlab::bounding_box_diagonal(shape.V) - 5) < 1e-12 ? EXIT_SUCCESS
                                                                          : EXIT_FAILURE;
}
