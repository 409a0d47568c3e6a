#include "geometry/shape/shape_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"

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
  return formats::substitute(bytes, file.layout, shape.V, shape.N);
}

}  // namespace

Shape read_shape(const fs::path& path) {
  const Format& format = format_of(path, "read");
  Shape shape = format.read(read_file(path), path.string()).shape;
  check(shape, path.string());
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
