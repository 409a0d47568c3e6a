#include "drawing/vector/normalized_svg.h"

#include <cairo-svg.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <pugixml.hpp>

#include "drawing/paint.h"
#include "drawing/vector/svg_work.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

/// Cairo rounds coordinates to 1/256 of a unit, and limits them to 2²³ units.
constexpr double kUnitsAcross = 1 << 21;
constexpr double kMostAcross = 1e6;  // [pixel]

/// This overrides the style sheets of the file. Because text is not shown, no fonts are searched.
constexpr std::string_view kStyleSheet =
    "text, image, foreignObject { display: none !important }"
    "* { filter: none !important; mask: none !important }";

constexpr const char* kOtherFiles = "references to other files";

struct Unref {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};

/// Calls function(&error). If it fails, throws InputError with its message.
template <class Function>
auto checked_call(const fs::path& name, const Function& function, const char* advice = "") {
  GError* raw = nullptr;
  const auto result = function(&raw);
  const std::unique_ptr<GError, Unref> error(raw);
  if (!result || error) {
    std::string what = error ? error->message : "librsvg gives no cause";
    std::ranges::replace(what, '\n', ' ');
    what.erase(what.find_last_not_of(' ') + 1);
    cannot_read(name, what + advice);
  }
  return result;
}

const guint8* unsigned_bytes(std::string_view text) {
  return reinterpret_cast<const guint8*>(text.data());
}

std::unique_ptr<RsvgHandle, Unref> open(const std::string& bytes, const fs::path& name) {
  std::unique_ptr<RsvgHandle, Unref> handle(checked_call(
      name,
      [&](GError** error) {
        return rsvg_handle_new_from_data(unsigned_bytes(bytes), bytes.size(), error);
      },
      "; the file is damaged, or it is not an SVG"));
  rsvg_handle_set_dpi(handle.get(), 96);
  return handle;
}

/// The file without blend modes, which make pictures of groups. An `!important` of the file would
/// win against kStyleSheet. Names that contain these words change everywhere alike.
std::string without_blending(std::string bytes) {
  for (const std::string_view property : {"mix-blend-mode", "isolation"})
    for (std::size_t at = bytes.find(property); at != bytes.npos; at = bytes.find(property, at))
      bytes[at] = '_';
  return bytes;
}

std::unique_ptr<RsvgHandle, Unref> open_for_curves(const std::string& bytes, const fs::path& name) {
  auto handle = open(without_blending(bytes), name);
  checked_call(name, [&](GError** error) {
    return rsvg_handle_set_stylesheet(handle.get(), unsigned_bytes(kStyleSheet), kStyleSheet.size(),
                                      error);
  });
  return handle;
}

/// Sets the size of the page. It is the size that the file gives, or else that of its view box, or
/// else the extent of what the file paints.
void set_size(RsvgHandle* handle, const fs::path& name, NormalizedSvg& svg) {
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle, &svg.width, &svg.height) == 0) {
    gboolean has_box = 0;
    RsvgRectangle box{};
    rsvg_handle_get_intrinsic_dimensions(handle, nullptr, nullptr, nullptr, nullptr, &has_box,
                                         &box);
    if (has_box == 0) {
      const RsvgRectangle viewport{0, 0, 1, 1};  // nothing but percentages depends on it
      checked_call(name, [&](GError** error) {
        return rsvg_handle_get_geometry_for_layer(handle, nullptr, &viewport, &box, nullptr, error);
      });
      box.width += box.x;
      box.height += box.y;
    }
    svg.width = box.width;
    svg.height = box.height;
  }
  if (!(svg.width > 0 && svg.height > 0)) cannot_read(name, "it shows nothing: its page is empty");
  const double longer = std::max(svg.width, svg.height);
  if (!(longer <= kMostAcross && std::min(svg.width, svg.height) >= longer / kMostAcross))
    cannot_read(name,
                fmt::format("its page is {}×{} pixels; at most a million pixels, and a million "
                            "times as long as wide, are allowed",
                            svg.width, svg.height));
}

NormalizedSvg sized(RsvgHandle* handle, const fs::path& name) {
  NormalizedSvg svg;
  set_size(handle, name, svg);
  svg.scale = kUnitsAcross / std::max(svg.width, svg.height);
  return svg;
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// Paints the element with the id, or the whole document.
void paint(RsvgHandle* handle, const fs::path& name, NormalizedSvg& svg,
           const std::string& id = "") {
  const RsvgRectangle page{0, 0, svg.width, svg.height};
  const std::unique_ptr<cairo_surface_t, Unref> surface(cairo_svg_surface_create_for_stream(
      append, &svg.text, svg.width * svg.scale, svg.height * svg.scale));
  const std::unique_ptr<cairo_t, Unref> cairo(cairo_create(surface.get()));
  // A file without a size and a view box does not fill a larger viewport.
  cairo_scale(cairo.get(), svg.scale, svg.scale);
  checked_call(name, [&](GError** error) {
    return id.empty()
               ? rsvg_handle_render_document(handle, cairo.get(), &page, error)
               : rsvg_handle_render_layer(handle, cairo.get(), ("#" + id).c_str(), &page, error);
  });
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    cannot_read(name, cairo_status_to_string(cairo_surface_status(surface.get())));
}

/// Counts what our style sheet hides, and references to other files.
struct Hidden : pugi::xml_tree_walker {
  std::map<std::string, int> counts;

  bool for_each(pugi::xml_node& node) override {
    const std::string_view qualified = node.name();
    const std::string_view name = qualified.substr(qualified.find(':') + 1);
    if (name == "text") ++counts["text"];
    if (name == "image" || name == "foreignObject") ++counts["images"];
    for (const pugi::xml_attribute& attribute : node.attributes())
      look_at(attribute.name(), attribute.value(), name == "a");
    return true;
  }

  void look_at(std::string_view name, std::string_view value, bool is_link) {
    for (const std::string& effect : {std::string("filter"), std::string("mask")}) {
      const bool here = name == effect && value.starts_with("url");
      const bool in_style = name == "style" && value.find(effect + ":url") != value.npos;
      if (here || in_style) ++counts[effect + "s"];
    }
    const bool reference = name == "href" || name.ends_with(":href");
    const bool inside = value.empty() || value.starts_with('#') || value.starts_with("data:");
    if (reference && !inside && !is_link) ++counts[kOtherFiles];
  }
};

}  // namespace

NormalizedSvg normalized_svg(const std::string& bytes, const fs::path& name) {
  pugi::xml_document document;
  Hidden hidden;
  if (document.load_buffer(bytes.data(), bytes.size())) document.traverse(hidden);
  check_svg_work(document, name);
  const auto handle = open_for_curves(bytes, name);
  NormalizedSvg svg = sized(handle.get(), name);
  paint(handle.get(), name, svg);
  for (const auto& [what, count] : hidden.counts)
    (what == kOtherFiles ? svg.notes : svg.not_curves)
        .push_back(fmt::format("left out: {} ({})", what, count));
  return svg;
}

std::vector<NormalizedSvg> normalized_elements(const std::string& bytes, const fs::path& name,
                                               const std::vector<std::string>& ids) {
  const auto handle = open_for_curves(bytes, name);
  const NormalizedSvg empty = sized(handle.get(), name);
  std::vector<NormalizedSvg> elements(ids.size(), empty);
  for (std::size_t i = 0; i < ids.size(); ++i) paint(handle.get(), name, elements[i], ids[i]);
  return elements;
}

Bitmap svg_picture(const std::string& bytes, const fs::path& name, double resolution) {
  const auto handle = open(bytes, name);
  const NormalizedSvg size = sized(open_for_curves(bytes, name).get(), name);
  const double width = std::max(1.0, std::round(size.width * resolution));
  const double height = std::max(1.0, std::round(size.height * resolution));
  const std::string problem = size_problem(width, height);
  if (!problem.empty()) throw InputError(fmt::format("cannot paint a page of {}", problem));
  const RsvgRectangle page{0, 0, size.width, size.height};
  return painted(static_cast<int>(width), static_cast<int>(height), [&](cairo_t* cairo) {
    cairo_scale(cairo, resolution, resolution);
    checked_call(name, [&](GError** error) {
      return rsvg_handle_render_document(handle.get(), cairo, &page, error);
    });
  });
}

}  // namespace deformlab
