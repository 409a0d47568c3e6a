#pragma once

#include "experiments/subjects/shape/edit.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The edit of a drawing in the grammar of a shape's: two coordinates become three, `circle` a
/// sphere, `rotate: 30` a rotation about the axis that turns x towards y, clockwise as an image
/// shows it. Throws InputError where a place has not two coordinates.
ConfigNode in_space(const ConfigNode& edit);

/// read_edit for a drawing.
std::vector<EditEntry> read_plane_edit(const ConfigNode& edit);

/// read_edit_file for a drawing.
std::vector<EditEntry> read_plane_edit_file(const std::filesystem::path& path);

/// `resolve` for a drawing's mesh at rest. A place that is rotated becomes a rotation handle with a
/// ring of 4 % of the drawing's diagonal around it, whatever the mesh.
ResolvedEdit resolve(const std::vector<EditEntry>& entries, const Triangulation& rest);

}  // namespace deformlab
