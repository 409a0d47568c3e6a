#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/config_node.h"
#include "experiments/subjects/shape/selection.h"

namespace deformlab {

/// One entry of `paint:`, which makes a part of a shape or a drawing stiff. Exactly one of select
/// and mask is given.
struct Coat {
  std::optional<Selection> select;
  std::optional<std::filesystem::path> mask;
  double weight = 10'000;  // Igarashi et al. 2005, section 5.2, for painted triangles
  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("select", o.select, "Vertices, selected as in an edit");
    visit("mask", o.mask,
          "A PNG image of the page's size, which is opaque and dark where triangles of a drawing "
          "are painted");
    visit("weight", o.weight, "The stiffness of what is painted; that of everything else is 1");
  }
};

/// An entry, what messages call it, and the folder from which its file is read.
struct ReadCoat {
  Coat coat;
  std::string where;
  std::filesystem::path folder;
};

/// Reads the list under `paint:`, which may be null. Throws InputError (naming the line) for
/// anything that is not in the grammar above, and for a weight that is not above 0.
std::vector<ReadCoat> read_coats(const ConfigNode& list);

/// Throws InputError for a list that cannot be painted onto a shape in space.
void check_shape_paint(const ConfigNode& list);

/// The stiffness of each vertex (#V), which the last entry that selects it gives; empty without
/// paint. Throws InputError as check_shape_paint does, and for a selection without vertices.
Eigen::VectorXd painted_stiffness(const ConfigNode& list, const Shape& rest);

}  // namespace deformlab
