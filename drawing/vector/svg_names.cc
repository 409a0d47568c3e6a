#include "drawing/vector/svg_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "drawing/vector/read_svg.h"
#include "drawing/vector/svg_values.h"

namespace deformlab {
namespace {

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// The elements that paint something themselves, in the order in which they are painted.
void collect(const pugi::xml_node& node, std::vector<pugi::xml_node>& leaves) {
  for (const pugi::xml_node& child : node.children()) {
    const std::string_view name = local_name(child.name());
    if (is_one_of(name, {"g", "a", "svg"})) collect(child, leaves);
    if (is_one_of(name, {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "use",
                         "switch"}))
      leaves.push_back(child);
  }
}

/// Whether all entities of the text are those that every XML file has.
bool is_portable(std::string_view text) {
  for (std::size_t at = text.find('&'); at != text.npos; at = text.find('&', at + 1)) {
    const std::string_view entity = text.substr(at + 1, text.find(';', at) - at - 1);
    if (!entity.starts_with('#') && !is_one_of(entity, {"amp", "lt", "gt", "quot", "apos"}))
      return false;
  }
  return text.find('<') == text.npos;
}

bool names_something(std::string_view name, bool is_link) {
  if (is_link && is_one_of(name, {"href", "xlink:href", "target"})) return true;
  return is_one_of(name, {"class", "role", "inkscape:label", "inkscape:groupmode"}) ||
         name.starts_with("data-") || name.starts_with("aria-");
}

/// Counts the elements that are blended and are not among those that are written.
struct LostBlending : pugi::xml_tree_walker {
  const BlendModes& modes;
  const std::set<pugi::xml_node>& written;
  int count = 0;

  LostBlending(const BlendModes& m, const std::set<pugi::xml_node>& w) : modes(m), written(w) {}
  bool for_each(pugi::xml_node& node) override {
    count +=
        node.type() == pugi::node_element && !written.contains(node) && !modes.of(node).empty();
    return true;
  }
};

}  // namespace

SvgNames::SvgNames(const std::string& bytes, const std::filesystem::path& name) {
  constexpr unsigned kAsItStands = pugi::parse_full & ~pugi::parse_escapes;
  if (!document_.load_buffer(bytes.data(), bytes.size(), kAsItStands)) return;
  std::vector<pugi::xml_node> leaves;
  collect(root(), leaves);
  pugi::xml_document marked;
  marked.reset(document_);
  std::vector<pugi::xml_node> copies;
  collect(marked.document_element(), copies);
  std::vector<std::string> ids;
  std::map<std::string, int> bearers;  // of each id
  for (const auto& found : marked.select_nodes("//@id")) ++bearers[found.attribute().value()];
  for (pugi::xml_node& copy : copies) {
    ids.push_back(fmt::format("deformlab-{}", ids.size()));
    if (!copy.attribute("id")) copy.append_attribute("id");
    // A reference or a rule of a style sheet may need the id, and an id may stand twice.
    const std::string own = copy.attribute("id").value();
    if (own.empty() || bearers[own] > 1) {
      copy.attribute("id").set_value(ids.back().c_str());
      --bearers[own];
    }
    ids.back() = copy.attribute("id").value();
  }
  std::ostringstream text;
  marked.save(text, "", pugi::format_raw | pugi::format_no_escapes);
  const std::vector<std::size_t> counts = count_paths(text.str(), name, ids);
  const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  blend_modes_ = BlendModes(root());
  const std::size_t together = read_svg(bytes, name).paths.size();
  if (all == together) {
    for (std::size_t i = 0; i < counts.size(); ++i)
      elements_.insert(elements_.end(), counts[i], leaves[i]);
  } else {
    notes_.push_back(fmt::format(
        "left out: ids, classes, groups, links and blend modes, because the file paints "
        "{} paths, but its elements paint {} one by one",
        together, all));
  }
  note_lost_blending();
}

void SvgNames::note_lost_blending() {
  std::set<pugi::xml_node> written;
  for (pugi::xml_node node : elements_)
    for (; node; node = node.parent()) written.insert(node);
  LostBlending lost(blend_modes_, written);
  root().traverse(lost);
  if (lost.count > 0)
    notes_.push_back(
        fmt::format("left out: the blend modes of {} elements that are not written as "
                    "they stand in the file; PNG output shows them",
                    lost.count));
  if (!blend_modes_.unread().empty())
    notes_.push_back(
        fmt::format("left out: the blend modes that a style sheet gives by {}; PNG "
                    "output shows them",
                    fmt::join(blend_modes_.unread(), ", ")));
}

pugi::xml_node SvgNames::element(int path) const {
  const auto i = static_cast<std::size_t>(path);
  return i < elements_.size() ? elements_[i] : pugi::xml_node();
}

bool SvgNames::has_id(const std::string& id) const {
  return static_cast<bool>(root().find_node(
      [&](const pugi::xml_node& node) { return id == node.attribute("id").value(); }));
}

void SvgNames::copy_to(const pugi::xml_node& from, pugi::xml_node to, bool with_id) const {
  const bool is_link = local_name(from.name()) == "a";
  for (const pugi::xml_attribute& attribute : from.attributes()) {
    const std::string_view name = attribute.name();
    const bool copied = name == "id" ? with_id : names_something(name, is_link);
    if (copied && is_portable(attribute.value())) to.append_copy(attribute);
  }
  const std::string blending = blend_modes_.of(from);
  if (!blending.empty() && is_portable(blending))
    to.append_attribute("style").set_value(blending.c_str());
  for (const pugi::xml_node& child : from.children())
    if (is_one_of(child.name(), {"title", "desc"}) && is_portable(child.child_value()))
      to.append_copy(child);
}

void copy_namespaces(const pugi::xml_node& from, pugi::xml_node to) {
  for (const pugi::xml_attribute& attribute : from.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "xmlns:inkscape")
      to.append_attribute("xmlns:inkscape")
          .set_value("http://www.inkscape.org/namespaces/inkscape");
    if (name == "xmlns:xlink")
      to.append_attribute("xmlns:xlink").set_value("http://www.w3.org/1999/xlink");
  }
}

}  // namespace deformlab
