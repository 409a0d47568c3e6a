#include "geometry/shape/formats/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geometry/core/files.h"

namespace deformlab::formats {
namespace {

using Kind = PlyType::Kind;

PlyType type_of(std::string_view word, const Lines& lines, const std::string& name) {
  static const std::map<std::string_view, PlyType> known = {
      {"char", {Kind::kSigned, 1}},     {"int8", {Kind::kSigned, 1}},
      {"uchar", {Kind::kUnsigned, 1}},  {"uint8", {Kind::kUnsigned, 1}},
      {"short", {Kind::kSigned, 2}},    {"int16", {Kind::kSigned, 2}},
      {"ushort", {Kind::kUnsigned, 2}}, {"uint16", {Kind::kUnsigned, 2}},
      {"int", {Kind::kSigned, 4}},      {"int32", {Kind::kSigned, 4}},
      {"uint", {Kind::kUnsigned, 4}},   {"uint32", {Kind::kUnsigned, 4}},
      {"float", {Kind::kReal, 4}},      {"float32", {Kind::kReal, 4}},
      {"double", {Kind::kReal, 8}},     {"float64", {Kind::kReal, 8}},
  };
  const auto found = known.find(word);
  if (found == known.end()) {
    cannot_read(name, fmt::format("{}: unknown type {}", lines.name(), quoted_ascii(word)));
  }
  return found->second;
}

Encoding read_format(const Lines& lines, const std::string& name) {
  static const std::map<std::string_view, Encoding> known = {
      {"ascii", Encoding::kText},
      {"binary_little_endian", Encoding::kLittleEndian},
      {"binary_big_endian", Encoding::kBigEndian}};
  const std::vector<Token>& words = lines.tokens();
  const auto found = known.find(words.size() > 1 ? words[1].text : "");
  if (found == known.end()) {
    cannot_read(name, lines.name() +
                          ": the format must be ascii, binary_little_endian or binary_big_endian");
  }
  return found->second;
}

PlyElement read_element(const Lines& lines, const std::string& name) {
  const std::vector<Token>& words = lines.tokens();
  const std::int64_t rows = words.size() == 3 ? to_integer(words[2].text).value_or(-1) : -1;
  if (rows < 0) {
    const std::string found = words.size() == 3 ? ", not " + quoted_ascii(words[2].text) : "";
    cannot_read(name, lines.name() + ": an element needs a name and a number of rows" + found);
  }
  return {std::string(words[1].text), static_cast<std::uint64_t>(rows), {}};
}

void read_property(const Lines& lines, PlyHeader& header, const std::string& name) {
  const std::vector<Token>& words = lines.tokens();
  const bool is_list = words.size() == 5 && words[1].text == "list";
  if (header.elements.empty() || !(words.size() == 3 || is_list)) {
    cannot_read(name, lines.name() + ": a property needs an element before it, a type and a name");
  }
  PlyProperty property;
  property.name = words.back().text;
  property.type = type_of(words[words.size() - 2].text, lines, name);
  property.line = lines.range();
  if (is_list) property.count_type = type_of(words[2].text, lines, name);
  if (is_list && property.count_type->kind == Kind::kReal) {
    cannot_read(name, lines.name() + ": the length of a list must be an integer");
  }
  header.elements.back().properties.push_back(property);
}

void check_vertices(const PlyElement& element, const std::string& name) {
  for (const char* axis : {"x", "y", "z"}) {
    const bool found = std::ranges::any_of(element.properties, [&](const PlyProperty& p) {
      return p.name == axis && !p.count_type && p.type.kind == Kind::kReal;
    });
    if (!found) cannot_read(name, fmt::format("its vertices need {} as float or double", axis));
  }
}

void check_elements(const PlyHeader& header, const std::string& name) {
  int vertex_elements = 0, face_elements = 0;
  for (const PlyElement& element : header.elements) {
    if (element.is_vertex()) {
      ++vertex_elements;
      check_vertices(element, name);
    } else if (element.is_face() && element.rows > 0) {
      ++face_elements;
      const bool found = std::ranges::any_of(element.properties, [](const PlyProperty& p) {
        return p.has_corners() && p.type.kind != Kind::kReal;
      });
      if (!found) {
        cannot_read(name,
                    "its faces need a list of integers called vertex_indices or vertex_index");
      }
    }
  }
  if (vertex_elements != 1 || face_elements > 1) {
    cannot_read(name, "it needs one element called vertex and at most one called face");
  }
}

bool is_known(std::string_view keyword) {
  return keyword == "format" || keyword == "element" || keyword == "property" ||
         keyword == "comment" || keyword == "obj_info" || keyword == "end_header";
}

/// The line that ends the header ends as the first one does. Where that is CR alone, an LF behind
/// it is a part of the body.
std::size_t body_begin(std::string_view bytes, ByteRange last_line) {
  const std::size_t first = bytes.find_first_of("\r\n");
  const bool cr_alone = bytes[first] == '\r' && bytes.substr(first + 1, 1) != "\n";
  const std::size_t end = last_line.at + last_line.size;
  return cr_alone && bytes.substr(end - 2, 2) == "\r\n" ? end - 1 : end;
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  PlyHeader header;
  bool has_format = false;
  Lines lines(bytes);
  if (!lines.next() || lines.tokens()[0].text != "ply") {
    cannot_read(name, "it does not begin with ply");
  }
  while (lines.next()) {
    const std::string_view keyword = lines.tokens()[0].text;
    if (keyword == "format") {
      header.encoding = read_format(lines, name);
      has_format = true;
    }
    if (keyword == "element") header.elements.push_back(read_element(lines, name));
    if (keyword == "property") read_property(lines, header, name);
    if (!is_known(keyword)) ++header.unknown[std::string(keyword)];
    if (keyword != "end_header") continue;
    if (!has_format) cannot_read(name, "its header names no format");
    check_elements(header, name);
    header.end = body_begin(bytes, lines.range());
    return header;
  }
  cannot_read(name, "its header has no end_header");
}

}  // namespace deformlab::formats
