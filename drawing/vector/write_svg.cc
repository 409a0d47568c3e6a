#include "drawing/vector/write_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "drawing/vector/gradient.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

/// Writes at most four digits after the point, in any locale.
std::string number(double value) {
  char text[64];
  const double rounded = std::round(value * 1e4) / 1e4 + 0.0;  // + 0 turns −0 into 0
  const auto end = std::to_chars(text, text + sizeof text, rounded).ptr;
  return {text, end};
}

std::string pair(const Eigen::Vector2d& p) { return number(p.x()) + " " + number(p.y()); }

std::string to_data(const Outlines& outlines) {
  std::string data;
  for (const Curve& curve : outlines.curves) {
    data += (data.empty() ? "M " : " M ") + pair(curve.points.col(0));
    for (Eigen::Index i = 1; i < curve.points.cols(); ++i)
      data += (i % 3 == 1 ? " C " : " ") + pair(curve.points.col(i));
    if (curve.closed) data += " Z";
  }
  return data;
}

std::string to_color(const std::array<double, 4>& color) {
  char text[8];
  const auto byte = [](double v) { return static_cast<unsigned>(std::lround(255 * v)) & 255; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(color[0]), byte(color[1]), byte(color[2]));
  return text;
}

class Writer {
 public:
  Writer(const std::vector<VectorPath>& paths, const SvgNames& names,
         const Eigen::AlignedBox2d& page)
      : names_(names) {
    root_ = document_.append_child("svg");
    set(root_, "xmlns", "http://www.w3.org/2000/svg");
    set(root_, "width", number(page.sizes().x()));
    set(root_, "height", number(page.sizes().y()));
    set(root_, "viewBox", pair(page.min()) + " " + pair(page.sizes()));
    copy_namespaces(names.root(), root_);
    names_.copy_to(names.root(), root_, names.root() && is_new(names.root()));
    definitions_ = root_.append_child("defs");
    for (const VectorPath& path : paths) add(path);
    if (!definitions_.first_child()) root_.remove_child(definitions_);
  }

  std::string text() const {
    std::ostringstream out;
    document_.save(out, " ", pugi::format_default | pugi::format_no_escapes);
    return out.str();
  }

 private:
  static void set(pugi::xml_node& node, const char* name, const std::string& value) {
    node.append_attribute(name).set_value(value.c_str());
  }

  void add(const VectorPath& path) {
    const pugi::xml_node element = names_.element(path.number);
    pugi::xml_node parent = group_of(element);
    for (const Outlines& clip : path.clips) {
      const std::string id = define(clip);
      parent = parent.append_child("g");
      set(parent, "clip-path", "url(#" + id + ")");
    }
    pugi::xml_node node = parent.append_child("path");
    if (element) names_.copy_to(element, node, is_new(element));
    set(node, "d", to_data(path.outlines));
    set_paint(node, "fill", path.fill);
    if (path.outlines.even_odd) set(node, "fill-rule", "evenodd");
    if (path.stroke.kind == Paint::Kind::kNone) return;
    set_paint(node, "stroke", path.stroke);
    set_line(node, path);
  }

  /// Whether the element has not been written before, so that its id can be given.
  bool is_new(const pugi::xml_node& element) {
    return written_.insert(element.attribute("id").value()).second;
  }

  /// The group to which what the element paints is added. Groups are those of the file. One that
  /// lies in several layers is written several times.
  pugi::xml_node group_of(const pugi::xml_node& element) {
    std::vector<pugi::xml_node> around;
    for (pugi::xml_node g = element.parent(); g && g != names_.root(); g = g.parent())
      around.insert(around.begin(), g);
    std::size_t same = 0;
    while (same < std::min(around.size(), open_.size()) && around[same] == open_[same].first)
      ++same;
    open_.resize(same);
    for (std::size_t i = same; i < around.size(); ++i) {
      pugi::xml_node parent = i == 0 ? root_ : open_[i - 1].second;
      const bool is_link = std::string_view(around[i].name()) == "a";
      pugi::xml_node group = parent.append_child(is_link ? "a" : "g");
      names_.copy_to(around[i], group, is_new(around[i]));
      open_.emplace_back(around[i], group);
    }
    return open_.empty() ? root_ : open_.back().second;
  }

  std::string new_id(const char* kind) {
    std::string id;
    do {
      id = fmt::format("{}{}", kind, ++count_);
    } while (names_.has_id(id));
    return id;
  }

  static void set_line(pugi::xml_node& node, const VectorPath& path) {
    set(node, "stroke-width", number(path.stroke_width));
    set(node, "stroke-miterlimit", number(path.miter_limit));
    if (path.cap != VectorPath::Cap::kButt)
      set(node, "stroke-linecap", path.cap == VectorPath::Cap::kRound ? "round" : "square");
    if (path.join != VectorPath::Join::kMiter)
      set(node, "stroke-linejoin", path.join == VectorPath::Join::kRound ? "round" : "bevel");
    std::string dashes;
    for (const double length : path.dashes) dashes += number(length) + " ";
    if (!dashes.empty()) set(node, "stroke-dasharray", dashes);
    if (!dashes.empty()) set(node, "stroke-dashoffset", number(path.dash_offset));
  }

  void set_paint(pugi::xml_node& node, const std::string& use, const Paint& paint) {
    if (paint.kind == Paint::Kind::kNone) return set(node, use.c_str(), "none");
    const bool flat = paint.kind == Paint::Kind::kColor;
    const auto frame = flat ? std::nullopt : frame_of(paint);
    if (frame) return set(node, use.c_str(), "url(#" + define(paint, *frame) + ")");
    const auto& color = paint.stops.back().color;
    set(node, use.c_str(), to_color(color));
    if (color[3] < 1) set(node, (use + "-opacity").c_str(), number(color[3]));
  }

  std::string define(const Outlines& clip) {
    pugi::xml_node node = definitions_.append_child("clipPath");
    std::string id = new_id("clip");
    set(node, "id", id);
    pugi::xml_node path = node.append_child("path");
    set(path, "d", to_data(clip));
    if (clip.even_odd) set(path, "clip-rule", "evenodd");
    return id;
  }

  std::string define(const Paint& paint, const GradientFrame& frame) {
    const bool radial = paint.kind == Paint::Kind::kRadial;
    pugi::xml_node node = definitions_.append_child(radial ? "radialGradient" : "linearGradient");
    std::string id = new_id("paint");
    set(node, "id", id);
    set(node, "gradientUnits", "userSpaceOnUse");
    const auto& m = frame.to_page.matrix();
    set(node, "gradientTransform",
        "matrix(" + pair(m.col(0).head<2>()) + " " + pair(m.col(1).head<2>()) + " " +
            pair(m.col(2).head<2>()) + ")");
    const std::vector<std::pair<const char*, double>> places =
        radial ? std::vector<std::pair<const char*, double>>{{"cx", 0},
                                                             {"cy", 0},
                                                             {"r", 1},
                                                             {"fx", frame.focus.x()},
                                                             {"fy", frame.focus.y()}}
               : std::vector<std::pair<const char*, double>>{
                     {"x1", 0}, {"y1", 0}, {"x2", 1}, {"y2", 0}};
    for (const auto& [name, value] : places) set(node, name, number(value));
    if (paint.spread != Paint::Spread::kPad)
      set(node, "spreadMethod", paint.spread == Paint::Spread::kRepeat ? "repeat" : "reflect");
    for (const auto& [offset, color] : paint.stops) {
      pugi::xml_node stop = node.append_child("stop");
      set(stop, "offset", number(offset));
      set(stop, "stop-color", to_color(color));
      if (color[3] < 1) set(stop, "stop-opacity", number(color[3]));
    }
    return id;
  }

  const SvgNames& names_;
  std::set<std::string> written_;                                ///< ids
  std::vector<std::pair<pugi::xml_node, pugi::xml_node>> open_;  ///< groups: the file's and ours
  pugi::xml_document document_;
  pugi::xml_node root_, definitions_;
  int count_ = 0;
};

}  // namespace

void write_svg(const std::vector<VectorPath>& paths, const SvgNames& names,
               const Eigen::AlignedBox2d& page, const std::filesystem::path& path) {
  write_file(path, Writer(paths, names, page).text());
}

}  // namespace deformlab
