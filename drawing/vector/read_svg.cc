#include "drawing/vector/read_svg.h"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "drawing/vector/curves.h"
#include "drawing/vector/normalized_svg.h"
#include "drawing/vector/svg_values.h"

namespace deformlab {
namespace {

using Style = std::map<std::string_view, std::string_view>;
using Box = Eigen::AlignedBox2d;

double number(std::string_view text, double otherwise) {
  const std::vector<double> values = numbers(text);
  return values.empty() ? otherwise : values.front();
}

double number(const Style& style, std::string_view key, double otherwise) {
  const auto found = style.find(key);
  return found == style.end() ? otherwise : number(found->second, otherwise);
}

std::string_view word(const Style& style, std::string_view key) {
  const auto found = style.find(key);
  return found == style.end() ? "none" : found->second;
}

/// The name in `url(#name)`, or an empty text.
std::string target(std::string_view text) {
  const std::size_t begin = text.find("(#"), end = text.find(')');
  if (!text.starts_with("url") || begin == text.npos || end == text.npos) return "";
  return std::string(text.substr(begin + 2, end - begin - 2));
}

/// Reads `rgb(100%,0%,50%)`.
std::array<double, 4> color(std::string_view text, double alpha) {
  std::vector<double> v = numbers(text);
  v.resize(3);
  return {v[0] / 100, v[1] / 100, v[2] / 100, alpha};
}

Box extent(const std::vector<Curve>& curves) {
  Box box;
  for (const Curve& curve : curves)
    for (const auto& point : curve.points.colwise()) box.extend(Eigen::Vector2d(point));
  return box;
}

/// Whether the outlines are a single rectangle along the axes.
bool is_box(const Outlines& outlines) {
  if (outlines.curves.size() != 1 || outlines.curves[0].points.cols() != 13) return false;
  const Eigen::Matrix2Xd& points = outlines.curves[0].points;
  for (Eigen::Index i = 0; i + 3 < points.cols(); i += 3) {
    const auto side = points.middleCols<4>(i);
    const Eigen::Vector2d size = side.rowwise().maxCoeff() - side.rowwise().minCoeff();
    if (size.minCoeff() != 0) return false;
  }
  return true;
}

class Reader {
 public:
  Reader(const NormalizedSvg& svg, VectorDrawing& drawing) : drawing_(drawing) {
    document_.load_buffer(svg.text.data(), svg.text.size());
    for (const auto& found : document_.select_nodes("//*[@id]"))
      by_id_[found.node().attribute("id").value()] = found.node();
    drawing.width = svg.width;
    drawing.height = svg.height;
    page_ = {Eigen::Vector2d(0, 0), Eigen::Vector2d(svg.width, svg.height)};
    State state;
    state.map.scale(1 / svg.scale);
    children(document_.child("svg"), state);
    for (const std::string& note : notes_) drawing.not_curves.push_back(note);
  }

 private:
  /// What an element inherits from the groups around it.
  struct State {
    Eigen::Affine2d map = Eigen::Affine2d::Identity();  ///< to the page
    double alpha = 1;
    std::vector<Outlines> clips = {};
  };

  pugi::xml_node find(const std::string& id) const {
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? pugi::xml_node() : found->second;
  }

  /// The element that `xlink:href="#name"` refers to.
  pugi::xml_node referred(const pugi::xml_node& use) const {
    const std::string reference = use.attribute("xlink:href").value();
    return find(reference.substr(std::min<std::size_t>(1, reference.size())));
  }

  void children(const pugi::xml_node& node, const State& state) {
    for (const pugi::xml_node& child : node) element(child, state);
  }

  void element(const pugi::xml_node& node, State state) {
    const std::string_view name = node.name();
    if (name != "path" && name != "rect" && name != "g" && name != "use") return;
    if (node.attribute("clip-path")) add_clip(node, state);
    if (node.attribute("mask"))
      state.alpha *= opacity_of(find(target(node.attribute("mask").value())));
    const Eigen::Affine2d own = matrix_of(node.attribute("transform").value());
    state.map = state.map * own;
    if (name == "g") return children(node, state);
    if (name == "use") return group(referred(node), state);
    add_path(node, state);
  }

  void group(const pugi::xml_node& node, const State& state) {
    const std::size_t before = drawing_.paths.size();
    element(node, state);
    if (state.alpha < 1 && drawing_.paths.size() > before + 1)
      notes_.insert("gave the opacity of a group to each of its objects");
  }

  std::vector<Curve> curves_in(const pugi::xml_node& node, const Eigen::Affine2d& map) const {
    if (std::string_view(node.name()) == "path") return curves_of(node.attribute("d").value(), map);
    const Eigen::Vector2d a(node.attribute("x").as_double(), node.attribute("y").as_double());
    const Eigen::Vector2d b = a + Eigen::Vector2d(node.attribute("width").as_double(),
                                                  node.attribute("height").as_double());
    Eigen::Matrix2Xd corners(2, 4);
    corners << a.x(), b.x(), b.x(), a.x(), a.y(), a.y(), b.y(), b.y();
    return {polygon(map * corners)};
  }

  void add_clip(const pugi::xml_node& node, State& state) const {
    Outlines clip;
    for (const pugi::xml_node& child : find(target(node.attribute("clip-path").value())))
      for (Curve& curve : curves_in(child, state.map)) clip.curves.push_back(std::move(curve));
    clip.even_odd = std::string_view(node.attribute("clip-rule").value()) == "evenodd";
    if (!is_box(clip) || !extent(clip.curves).contains(page_)) state.clips.push_back(clip);
  }

  /// Cairo writes the opacity of a group as a mask with a rectangle of this opacity.
  static double opacity_of(const pugi::xml_node& mask) {
    return number(style_of(mask.child("g").child("rect").attribute("style").value()),
                  "fill-opacity", 1);
  }

  void add_path(const pugi::xml_node& node, const State& state) {
    const Style style = style_of(node.attribute("style").value());
    VectorPath path;
    path.outlines = {curves_in(node, state.map), word(style, "fill-rule") == "evenodd"};
    path.fill = paint(style, "fill", state);
    path.stroke = paint(style, "stroke", state);
    if (path.stroke.kind != Paint::Kind::kNone) set_stroke(style, state.map, path);
    const bool painted = path.fill.kind != Paint::Kind::kNone || path.stroke_width > 0;
    if (!painted || path.outlines.curves.empty()) return;
    Box reach = extent(path.outlines.curves);
    const double half = path.stroke_width * std::max(1.0, path.miter_limit) / 2;
    reach = {reach.min().array() - half, reach.max().array() + half};
    for (const Outlines& clip : state.clips)
      if (!is_box(clip) || !extent(clip.curves).contains(reach)) path.clips.push_back(clip);
    path.number = static_cast<int>(drawing_.paths.size());
    drawing_.paths.push_back(std::move(path));
  }

  static void set_stroke(const Style& style, const Eigen::Affine2d& map, VectorPath& path) {
    const double scale = std::sqrt(std::abs(map.linear().determinant()));
    path.stroke_width = scale * number(style, "stroke-width", 1);
    path.miter_limit = number(style, "stroke-miterlimit", 4);
    const std::string_view cap = word(style, "stroke-linecap"),
                           join = word(style, "stroke-linejoin");
    path.cap = cap == "round"    ? VectorPath::Cap::kRound
               : cap == "square" ? VectorPath::Cap::kSquare
                                 : VectorPath::Cap::kButt;
    path.join = join == "round"   ? VectorPath::Join::kRound
                : join == "bevel" ? VectorPath::Join::kBevel
                                  : VectorPath::Join::kMiter;
    for (const double length : numbers(word(style, "stroke-dasharray")))
      path.dashes.push_back(scale * length);
    path.dash_offset = scale * number(style, "stroke-dashoffset", 0);
  }

  Paint paint(const Style& style, const std::string& use, const State& state) {
    const std::string_view value = word(style, use);
    if (value == "none") return {};
    const double alpha = state.alpha * number(style, use + "-opacity", 1);
    const pugi::xml_node server = find(target(value));
    if (!server) return one_color(color(value, alpha));
    const std::string_view name = server.name();
    if (name == "linearGradient" || name == "radialGradient")
      return gradient(server, name == "radialGradient", alpha, state.map);
    notes_.insert("painted patterns in one colour");
    const pugi::xml_node first = referred(server.child("use")).child("path");
    const Style inner = style_of(first.attribute("style").value());
    return one_color(color(word(inner, "fill"), alpha));
  }

  static Paint gradient(const pugi::xml_node& node, bool radial, double alpha,
                        const Eigen::Affine2d& to_page) {
    Paint paint;
    paint.kind = radial ? Paint::Kind::kRadial : Paint::Kind::kLinear;
    const std::string_view spread = node.attribute("spreadMethod").value();
    paint.spread = spread == "repeat"    ? Paint::Spread::kRepeat
                   : spread == "reflect" ? Paint::Spread::kReflect
                                         : Paint::Spread::kPad;
    for (const pugi::xml_node& stop : node.children("stop")) {
      const Style style = style_of(stop.attribute("style").value());
      const double opacity = alpha * number(style, "stop-opacity", 1);
      paint.stops.push_back(
          {stop.attribute("offset").as_double(), color(word(style, "stop-color"), opacity)});
    }
    if (paint.stops.empty()) return {};
    const auto at = [&](const char* x, const char* y) {
      return Eigen::Vector2d(node.attribute(x).as_double(), node.attribute(y).as_double());
    };
    Eigen::Matrix2Xd points(2, radial ? 4 : 3);
    if (radial) {
      const Eigen::Vector2d center = at("cx", "cy");
      const double r = node.attribute("r").as_double();
      points << center, center + Eigen::Vector2d(r, 0), center + Eigen::Vector2d(0, r),
          at("fx", "fy");
    } else {
      const Eigen::Vector2d from = at("x1", "y1"), to = at("x2", "y2");
      points << from, to, from + Eigen::Vector2d(from.y() - to.y(), to.x() - from.x());
    }
    paint.points = to_page * (matrix_of(node.attribute("gradientTransform").value()) * points);
    return paint;
  }

  VectorDrawing& drawing_;
  pugi::xml_document document_;
  std::map<std::string, pugi::xml_node> by_id_;
  Box page_;
  std::set<std::string> notes_;
};

}  // namespace

VectorDrawing read_svg(const std::string& bytes, const std::filesystem::path& name) {
  const NormalizedSvg svg = normalized_svg(bytes, name);
  VectorDrawing drawing;
  drawing.notes = svg.notes;
  drawing.not_curves = svg.not_curves;
  const Reader reader(svg, drawing);
  return drawing;
}

std::vector<std::size_t> count_paths(const std::string& bytes, const std::filesystem::path& name,
                                     const std::vector<std::string>& ids) {
  std::vector<std::size_t> counts;
  for (const NormalizedSvg& svg : normalized_elements(bytes, name, ids)) {
    VectorDrawing drawing;
    const Reader reader(svg, drawing);
    counts.push_back(drawing.paths.size());
  }
  return counts;
}

}  // namespace deformlab
