#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "drawing/vector/blend_modes.h"

namespace deformlab {

/// The elements of an SVG that its paths come from, so that names, groups, layers and links can be
/// written again. Texts are kept as they stand in the file, with their entities.
class SvgNames {
 public:
  SvgNames() = default;
  /// If the elements one by one do not paint as many paths as the whole file, only the root element
  /// has names.
  SvgNames(const std::string& bytes, const std::filesystem::path& name);

  /// The svg element, or an empty node.
  pugi::xml_node root() const { return document_.document_element(); }
  /// The element that painted a path, or an empty node.
  pugi::xml_node element(int path) const;
  /// Whether an element has this id.
  bool has_id(const std::string& id) const;
  /// What the user should know, such as names that cannot be written again.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Copies what names an element: its id, class, title and description, the label and mode of a
  /// layer, `data-` and `aria-` attributes, the target of a link, and how it is blended. Attributes
  /// with entities that the file itself defines are left out.
  void copy_to(const pugi::xml_node& from, pugi::xml_node to, bool with_id) const;

 private:
  void note_lost_blending();

  pugi::xml_document document_;
  BlendModes blend_modes_;
  std::vector<std::string> notes_;
  std::vector<pugi::xml_node> elements_;  ///< for each path
};

/// Copies the namespaces that names may use.
void copy_namespaces(const pugi::xml_node& from, pugi::xml_node to);

}  // namespace deformlab
