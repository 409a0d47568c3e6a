#include "geometry/shape/shape_ply_header.h"

#include <algorithm>
#include <map>

#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

using Kind = PlyType::Kind;

PlyType type_of(std::string_view word, const std::string& name, const std::string& line) {
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
  if (found == known.end()) reject(name, line + ": unknown type " + quoted(word));
  return found->second;
}

void read_format(const Lines& lines, PlyHeader& header, const std::string& name) {
  static const std::map<std::string_view, Encoding> known = {
      {"ascii", Encoding::kText},
      {"binary_little_endian", Encoding::kLittleEndian},
      {"binary_big_endian", Encoding::kBigEndian}};
  const std::vector<Token>& words = lines.tokens();
  const auto found = known.find(words.size() > 1 ? words[1].text : "");
  if (found == known.end()) {
    reject(name, lines.number() +
                     ": the format must be ascii, binary_little_endian or binary_big_endian");
  }
  header.format = found->first;
  header.encoding = found->second;
}

void read_element(const Lines& lines, PlyHeader& header, const std::string& name) {
  const std::vector<Token>& words = lines.tokens();
  const std::int64_t rows = words.size() == 3 ? to_integer(words[2].text).value_or(-1) : -1;
  if (rows < 0) reject(name, lines.number() + ": an element needs a name and a number of rows");
  header.elements.push_back({std::string(words[1].text), static_cast<std::uint64_t>(rows), {}});
}

void read_property(const Lines& lines, PlyHeader& header, const std::string& name) {
  const std::vector<Token>& words = lines.tokens();
  const bool is_list = words.size() == 5 && words[1].text == "list";
  if (header.elements.empty() || !(words.size() == 3 || is_list)) {
    reject(name, lines.number() + ": a property needs an element before it, a type and a name");
  }
  PlyProperty property;
  property.name = words.back().text;
  property.type_name = words[words.size() - 2].text;
  property.type = type_of(property.type_name, name, lines.number());
  property.line = lines.span();
  if (is_list) property.count_type = type_of(words[2].text, name, lines.number());
  if (is_list && property.count_type->kind == Kind::kReal) {
    reject(name, lines.number() + ": the length of a list must be an integer");
  }
  header.elements.back().properties.push_back(property);
}

bool has(const PlyElement& element, std::string_view wanted, bool is_list) {
  return std::ranges::any_of(element.properties, [&](const PlyProperty& property) {
    return property.name == wanted && property.count_type.has_value() == is_list &&
           (property.type.kind == Kind::kReal) == !is_list;
  });
}

void check_elements(const PlyHeader& header, const std::string& name) {
  int vertex_elements = 0, face_elements = 0;
  for (const PlyElement& element : header.elements) {
    if (element.is_vertex()) {
      ++vertex_elements;
      for (const char* axis : {"x", "y", "z"}) {
        if (!has(element, axis, false)) {
          reject(name, std::string("its vertices need ") + axis + " as float or double");
        }
      }
    } else if (element.is_face() && element.rows > 0) {
      ++face_elements;
      if (!has(element, "vertex_indices", true) && !has(element, "vertex_index", true)) {
        reject(name, "its faces need a list of integers called vertex_indices or vertex_index");
      }
    } else if (element.name == "tristrips" && element.rows > 0) {
      reject(name, "it holds triangle strips; write it with faces instead");
    }
  }
  if (vertex_elements != 1 || face_elements > 1) {
    reject(name, "it needs one element called vertex and at most one called face");
  }
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  PlyHeader header;
  Lines lines(bytes);
  if (!lines.next() || lines.tokens()[0].text != "ply") reject(name, "it does not begin with ply");
  while (lines.next()) {
    const std::string_view keyword = lines.tokens()[0].text;
    if (keyword == "format") read_format(lines, header, name);
    if (keyword == "element") read_element(lines, header, name);
    if (keyword == "property") read_property(lines, header, name);
    if (keyword != "end_header") continue;
    if (header.format.empty()) reject(name, "its header names no format");
    check_elements(header, name);
    header.end = lines.span().at + lines.span().size;
    return header;
  }
  reject(name, "its header has no end_header");
}

}  // namespace deformlab::formats
