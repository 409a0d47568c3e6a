#include "geometry/shape_io.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "geometry/error.h"
#include "geometry/shape_text.h"

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
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::ranges::find(kFormats, extension, &Format::extension);
  if (found == kFormats.end()) {
    throw InputError("cannot " + verb + " '" + path.string() + "': unknown extension '" +
                     extension + "'; known: .off, .obj, .ply, .stl, .xyz");
  }
  return *found;
}

std::string read_bytes(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status)) formats::reject(path.string(), "no such file");
  if (!fs::is_regular_file(status)) formats::reject(path.string(), "it is not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) formats::reject(path.string(), std::strerror(errno));
  std::string bytes(fs::file_size(path), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) formats::reject(path.string(), "it could not be read to its end");
  if (bytes.empty()) formats::reject(path.string(), "it is empty");
  return bytes;
}

[[noreturn]] void reject_target(const fs::path& out, const std::string& why) {
  throw InputError("cannot write '" + out.string() + "': " + why);
}

/// Through a temporary file beside the target, so that the target is old or new, never half.
void write_bytes(const fs::path& out, std::string_view bytes) {
  std::error_code error;
  const fs::path target = fs::exists(out, error) ? fs::canonical(out, error) : out;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    reject_target(out, "there is no folder '" + folder.string() + "'; make it first");
  }
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
    reject_target(out, "it exists and is not a file");
  }
  const fs::path temporary =
      folder / (target.filename().string() + ".tmp" + std::to_string(::getpid()));
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  if (!file) {
    reject_target(out, "folder '" + folder.string() + "': " + std::strerror(errno));
  }
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (fs::exists(target, error))
    fs::permissions(temporary, fs::status(target).permissions(), error);
  if (file) fs::rename(temporary, target, error);
  if (!file || error) {
    const std::string why = file ? error.message() : "the disk may be full";
    fs::remove(temporary, error);
    reject_target(out, "folder '" + folder.string() + "': " + why);
  }
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
  const std::string bytes = read_bytes(source);
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
  const std::string bytes = read_bytes(path);
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
  write_bytes(out, copies ? rewrite(source, shape) : format.print(shape));
}

}  // namespace deformlab
