#include "geometry/shape/shape_io.h"

#include <algorithm>
#include <array>
#include <string>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/shape_text.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view extension;
  formats::Scan (*scan)(std::string_view bytes, const std::string& name);
  bool (*parse)(const std::string& plain, Shape& shape);
  std::string (*print)(const Shape& shape);
};

constexpr std::array<Format, 5> kFormats = {{
    {".off", formats::scan_off, formats::parse_off, formats::print_off},
    {".obj", formats::scan_obj, formats::parse_obj, formats::print_obj},
    {".ply", formats::scan_ply, formats::parse_ply, formats::print_ply},
    {".stl", formats::scan_stl, formats::parse_stl, formats::print_stl},
    {".xyz", formats::scan_xyz, formats::parse_xyz, formats::print_xyz},
}};

const Format& format_of(const fs::path& path, const std::string& verb) {
  const std::string extension = extension_of(path);
  const auto found = std::ranges::find(kFormats, extension, &Format::extension);
  if (found == kFormats.end()) {
    throw InputError("cannot " + verb + " '" + path.string() + "': unknown extension '" +
                     extension + "'; known: .off, .obj, .ply, .stl, .xyz");
  }
  return *found;
}

/// The normals of a file that has one a vertex, normalised; else 3×0.
Eigen::Matrix3Xd normals(const formats::Layout& layout, std::string_view bytes,
                         std::size_t vertices) {
  if (layout.normals.size() != 3 * vertices) return {};
  Eigen::Matrix3Xd N(3, static_cast<Eigen::Index>(vertices));
  for (std::size_t i = 0; i < layout.normals.size(); ++i) {
    N(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3)) =
        formats::value_at(bytes, layout.normals[i], layout.encoding);
  }
  for (Eigen::Index i = 0; i < N.cols(); ++i) N.col(i).stableNormalize();
  return N;
}

std::string rewrite(const fs::path& source, const Shape& shape) {
  const std::string bytes = read_file(source);
  const Format& format = format_of(source, "read");
  const formats::Scan scan = format.scan(bytes, source.string());
  if (format.extension == ".stl") return formats::rewrite_stl(bytes, scan.layout, shape);
  if (scan.vertices != static_cast<std::size_t>(shape.V.cols())) {
    throw InputError("a shape of " + std::to_string(shape.V.cols()) +
                     " vertices does not come from '" + source.string() + "', which has " +
                     std::to_string(scan.vertices) + "; write it without a source");
  }
  return formats::substitute(bytes, scan.layout, shape.V, shape.N);
}

}  // namespace

Shape read_shape(const fs::path& path) {
  const std::string name = path.string();
  const Format& format = format_of(path, "read");
  const std::string bytes = read_file(path);
  const formats::Scan scan = format.scan(bytes, name);
  Shape shape;
  const bool parsed = format.parse(scan.plain, shape);
  const bool is_stl = format.extension == ".stl";
  if (!is_stl) shape.N = normals(scan.layout, bytes, scan.vertices);
  if (static_cast<std::size_t>(shape.V.cols()) == scan.vertices || is_stl) check(shape, name);
  if (!parsed || shape.faces.size() != scan.faces ||
      (!is_stl && static_cast<std::size_t>(shape.V.cols()) != scan.vertices)) {
    formats::reject(name, "CGAL found " + std::to_string(shape.V.cols()) + " vertices and " +
                              std::to_string(shape.faces.size()) + " faces of " +
                              std::to_string(scan.vertices) + " and " + std::to_string(scan.faces));
  }
  return shape;
}

void check_extension(const fs::path& out) { format_of(out, "write"); }

void write_shape(const fs::path& out, const Shape& shape, const fs::path& source) {
  const Format& format = format_of(out, "write");
  check(shape, out.string());
  const bool copies = !source.empty() && &format_of(source, "read") == &format;
  write_file(out, copies ? rewrite(source, shape) : format.print(shape));
}

}  // namespace deformlab
