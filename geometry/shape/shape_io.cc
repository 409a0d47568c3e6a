#include "geometry/shape/shape_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"
#include "geometry/shape/formats/numbers.h"
#include "geometry/shape/formats/turning.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view extension;
  formats::ShapeFile (*read)(std::string_view bytes, const std::string& name);
  std::string (*print)(const Shape& shape);
};

constexpr std::array<Format, 5> kFormats = {{
    {".off", formats::read_off, formats::print_off},
    {".obj", formats::read_obj, formats::print_obj},
    {".ply", formats::read_ply, formats::print_ply},
    {".stl", formats::read_stl, formats::print_stl},
    {".xyz", formats::read_xyz, formats::print_xyz},
}};

const Format& format_of(const fs::path& path, std::string_view verb) {
  const std::string extension = extension_of(path);
  const auto found = std::ranges::find(kFormats, extension, &Format::extension);
  if (found == kFormats.end()) {
    throw InputError(
        fmt::format("cannot {} '{}': unknown extension '{}'; known: .off, .obj, .ply, .stl, .xyz",
                    verb, path.string(), extension));
  }
  return *found;
}

std::string rewrite(const fs::path& source, const Shape& shape) {
  const std::string bytes = read_file(source);
  const Format& format = format_of(source, "read");
  const formats::ShapeFile file = format.read(bytes, source.string());
  if (format.extension == ".stl") return formats::rewrite_stl(bytes, file.layout, shape);
  if (file.shape.V.cols() != shape.V.cols()) {
    throw InputError(fmt::format(
        "a shape of {} vertices does not come from '{}', which has {}; write it without a source",
        shape.V.cols(), source.string(), file.shape.V.cols()));
  }
  return formats::substitute(bytes, file.layout, shape.V, shape.N,
                             formats::turn(bytes, file, shape.V));
}

/// Many programs take a byte order mark for a part of the first word, and UTF-8 does not need it.
std::string without_mark(std::string bytes) {
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, kByteOrderMark.size());
  return bytes;
}

/// The shape with the vertices of its source that have no position, which become NaN.
Shape with_missing(const Shape& shape, const fs::path& source) {
  const std::vector<int> missing =
      format_of(source, "read").read(read_file(source), source.string()).missing;
  Shape whole{Eigen::Matrix3Xd(3, shape.V.cols() + std::ssize(missing)), Eigen::Matrix3Xd(3, 0),
              shape.faces};
  whole.V.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (shape.N.cols() > 0) whole.N = whole.V;
  std::vector<int> place;
  for (int i = 0; i < whole.V.cols(); ++i) {
    if (std::ranges::binary_search(missing, i)) continue;
    const auto from = std::ssize(place);
    if (from == shape.V.cols()) break;
    whole.V.col(i) = shape.V.col(from);
    if (shape.N.cols() > 0) whole.N.col(i) = shape.N.col(from);
    place.push_back(i);
  }
  for (auto& face : whole.faces) {
    for (int& vertex : face) vertex = place[static_cast<std::size_t>(vertex)];
  }
  return whole;
}

}  // namespace

Shape read_shape(const fs::path& path, std::vector<std::string>* notes) {
  const Format& format = format_of(path, "read");
  formats::ShapeFile file = format.read(read_file(path), path.string());
  check(file.shape, path.string());
  if (notes) {
    for (const std::string& note : file.notes) {
      notes->push_back(fmt::format("'{}': {}", path.string(), note));
    }
  }
  return std::move(file.shape);
}

void check_extension(const fs::path& out) { format_of(out, "write"); }

bool is_shape_file(const fs::path& path) {
  return std::ranges::find(kFormats, extension_of(path), &Format::extension) != kFormats.end();
}

void write_shape(const fs::path& out, const Shape& shape, const fs::path& source) {
  const Format& format = format_of(out, "write");
  check(shape, out.string());
  if (source.empty()) return write_file(out, format.print(shape));
  if (&format_of(source, "read") == &format) {
    return write_file(out, without_mark(rewrite(source, shape)));
  }
  const bool has_facets_only = format.extension == ".stl";
  write_file(out, format.print(has_facets_only ? shape : with_missing(shape, source)));
}

}  // namespace deformlab
