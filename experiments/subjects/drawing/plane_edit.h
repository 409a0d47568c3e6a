#pragma once

#include <functional>

#include "experiments/subjects/shape/edit.h"
#include "geometry/core/options.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Translates the edit of a drawing into that of a shape. Two coordinates become three, `circle`
/// becomes a sphere, and `rotate: 30` becomes a rotation about the axis that turns x towards y,
/// which is clockwise in an image. Throws InputError if a point does not have two coordinates.
ConfigNode in_space(const ConfigNode& edit);

/// The message with `.circle` for each `.sphere`.
std::string naming_circles(std::string message);

/// Calls action(). Its InputErrors about the sphere that in_space makes name the circle of the
/// file.
template <class Action>
decltype(auto) with_circles(Action&& action) {
  try {
    return action();
  } catch (const OptionError&) {
    throw;
  } catch (const InputError& error) {
    throw InputError(naming_circles(error.what()));
  }
}

/// The same as read_edit, for a drawing.
std::vector<EditEntry> read_plane_edit(const ConfigNode& edit);

/// A selection that turns in one list of an animation has an angle in all of them, which is 0 where
/// none is given: such an entry gets `rotate: 0`, so that the ring of a point has a place in each.
void complete_angles(const std::vector<std::vector<EditEntry>*>& lists);

/// The entries with each point that is outside of the mesh but belongs to the drawing moved to the
/// nearest place of the mesh. Its target moves by the same way.
std::vector<EditEntry> on_mesh(std::vector<EditEntry> entries, const Triangulation& rest,
                               const std::function<bool(const Eigen::Vector2d&)>& belongs);

/// The same as `resolve`, for a drawing's mesh at rest. A point that is rotated becomes a rotation
/// handle with a ring around it, whose radius is 4 % of the drawing's diagonal.
ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Triangulation& rest);

}  // namespace deformlab
