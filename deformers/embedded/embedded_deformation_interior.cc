#include <fmt/format.h>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/handles/winding.h"
#include "geometry/core/error.h"
#include "geometry/graph/placement/graph_interior.h"

// Nodes inside a closed shape.
namespace deformlab {

void EmbeddedDeformation::check_interior() const {
  if (options_.graph.interior != InteriorNodes::kOn) return;
  const auto refuse = [](const std::string& why) {
    throw OptionError("graph.interior", "on", why + ", or take interior: off");
  };
  if (const auto open = why_open(rest_)) {
    refuse(fmt::format(", which needs a closed surface, but {}; close it", *open));
  }
  if (!cuts_.empty()) refuse(", but nodes inside would join what a cut separates; leave 'cut' out");
}

bool EmbeddedDeformation::wants_interior() const {
  switch (options_.graph.interior) {
    case InteriorNodes::kOff:
      return false;
    case InteriorNodes::kOn:
      return true;
    case InteriorNodes::kAuto:
      break;
  }
  const double turn = turn_between_neighbors(graph_, handles_, rotations_, nodes_at_rest());
  if (!(turn > kMoreThanHalfTurn && cuts_.empty())) return false;
  return has_interior_ || !why_open(rest_);  // where there are some, the shape is closed
}

bool EmbeddedDeformation::fit_interior() {
  const bool wanted = wants_interior();
  if (wanted == has_interior_) return false;
  const GraphOptions& o = options_.graph;
  set_graph(wanted ? with_interior(rest_, surface_graph_, o.interior_spacing, o.alpha)
                   : surface_graph_);
  has_interior_ = wanted;
  return true;
}

}  // namespace deformlab
