#include "experiments/config/renamed_names.h"

#include <array>

namespace deformlab {
namespace {

struct Renamed {
  std::string_view old_name, new_name;
};

constexpr std::array kRenamed{
    Renamed{"separable_cg", "kronecker_cg"},
    Renamed{"rigid_shape", "arap_2d"},
    Renamed{"arap", "cgal_arap"},
    Renamed{"graph.adaptive", "adaptive"},
    Renamed{"picture.stages", "picture.steps"},
    Renamed{"output.stages", "output.steps"},
    Renamed{"output.grow", "output.page"},
    Renamed{"stages", "general_solver"},
};

}  // namespace

std::string_view renamed(std::string_view old_name) {
  for (const Renamed& entry : kRenamed) {
    if (entry.old_name == old_name) return entry.new_name;
  }
  return {};
}

}  // namespace deformlab
