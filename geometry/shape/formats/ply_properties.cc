#include <algorithm>
#include <array>
#include <set>

#include "geometry/shape/formats/ply_header.h"

namespace deformlab::formats {
namespace {

const std::vector<PlyVector>& known_vectors() {
  static const std::vector<PlyVector> known = {{"vx", "vy", "vz"},
                                               {"velocity_x", "velocity_y", "velocity_z"},
                                               {"vel_x", "vel_y", "vel_z"},
                                               {"tx", "ty", "tz"},
                                               {"tangent_x", "tangent_y", "tangent_z"},
                                               {"bx", "by", "bz"},
                                               {"bitangent_x", "bitangent_y", "bitangent_z"},
                                               {"normal_x", "normal_y", "normal_z"},
                                               {"rot_0", "rot_1", "rot_2", "rot_3"}};
  return known;
}

/// Properties of vertices and faces that need no turn.
bool is_fixed(const std::string& name) {
  static const std::set<std::string, std::less<>> known = {"x",
                                                           "y",
                                                           "z",
                                                           "nx",
                                                           "ny",
                                                           "nz",
                                                           "red",
                                                           "green",
                                                           "blue",
                                                           "alpha",
                                                           "r",
                                                           "g",
                                                           "b",
                                                           "a",
                                                           "s",
                                                           "t",
                                                           "u",
                                                           "v",
                                                           "texture_u",
                                                           "texture_v",
                                                           "texcoord",
                                                           "texnumber",
                                                           "intensity",
                                                           "confidence",
                                                           "quality",
                                                           "flags",
                                                           "label",
                                                           "opacity",
                                                           "value",
                                                           "radius",
                                                           "scale_0",
                                                           "scale_1",
                                                           "scale_2",
                                                           "f_dc_0",
                                                           "f_dc_1",
                                                           "f_dc_2",
                                                           "curvature",
                                                           "material_index",
                                                           "vertex_indices",
                                                           "vertex_index"};
  return known.contains(name) || name.starts_with("diffuse_") || name.starts_with("ambient_") ||
         name.starts_with("specular_") || name.starts_with("scalar_");
}

/// Whether it belongs to something that has a direction.
bool is_directed(const std::string& name) {
  constexpr std::string_view kAxes = "xyzXYZ";
  return name.starts_with("f_rest_") || name.starts_with("rot_") ||
         kAxes.find(name.back()) != std::string_view::npos;
}

}  // namespace

bool has_all(const PlyElement& element, const PlyVector& names) {
  return std::ranges::all_of(names, [&](const std::string& name) {
    const auto found = std::ranges::find(element.properties, name, &PlyProperty::name);
    return found != element.properties.end() && !found->count_type &&
           found->type.kind == PlyType::Kind::kReal;
  });
}

std::vector<PlyVector> turning_vectors(const PlyElement& element) {
  std::vector<PlyVector> result;
  for (const PlyVector& names : known_vectors()) {
    if (has_all(element, names)) result.push_back(names);
  }
  return result;
}

std::vector<std::string> notes_of(const PlyHeader& header) {
  Leftovers elements, directed, others;
  for (const PlyElement& element : header.elements) {
    if (!element.is_vertex() && !element.is_face()) {
      elements[element.name] += element.rows;
      continue;
    }
    std::set<std::string> turned;
    if (element.is_vertex()) {
      for (const PlyVector& names : turning_vectors(element))
        turned.insert(names.begin(), names.end());
    }
    for (const PlyProperty& property : element.properties) {
      const std::string& name = property.name;
      if (is_fixed(name) || turned.contains(name)) continue;
      ++(element.is_vertex() && is_directed(name) ? directed : others)[name];
    }
  }
  std::vector<std::string> notes;
  note_leftovers(notes, "lines of unknown kinds", header.unknown, "are kept as they are");
  note_leftovers(notes, "elements other than vertices and faces", elements, "are kept as they are");
  note_leftovers(notes, "unknown properties", others, "are kept as they are");
  note_leftovers(notes, "properties that may have a direction", directed,
                 "are kept as they are: they do not turn with the shape");
  return notes;
}

}  // namespace deformlab::formats
