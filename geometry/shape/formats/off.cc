#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {
namespace {

struct Header {
  std::size_t vertices = 0, faces = 0;
  bool has_normals = false;
};

/// Reads [ST][C][N]OFF, the letters in any order.
void read_keyword(const std::vector<Token>& tokens, Layout& layout, Header& header,
                  const std::string& name) {
  std::string letters(tokens[0].text);
  if (!letters.ends_with("OFF")) {
    cannot_read(name, "it does not begin with OFF, COFF, NOFF or the like");
  }
  letters.resize(letters.size() - 3);
  if (letters.find_first_not_of("STCN") != std::string::npos ||
      (tokens.size() > 1 && tokens[1].text == "BINARY")) {
    cannot_read(name,
                "of the OFF formats only the text ones with three coordinates are known: "
                "OFF with C, N or ST before it; write it as one of these, or as PLY");
  }
  const std::size_t n = letters.find('N');
  header.has_normals = n != std::string::npos;
  if (header.has_normals) layout.normal_traces.push_back({tokens[0].at + n, 1});
}

Header read_header(Lines& lines, Layout& layout, const std::string& name) {
  Header header;
  if (!lines.next()) cannot_read(name, "it has nothing but blanks and comments");
  read_keyword(lines.tokens(), layout, header, name);
  std::span<const Token> counts(lines.tokens());
  counts = counts.subspan(1);
  if (counts.empty() && lines.next()) counts = lines.tokens();
  const auto count = [&](std::size_t i) {
    const std::int64_t value = i < counts.size() ? to_integer(counts[i].text).value_or(-1) : -1;
    if (value < 0) {
      const std::string found =
          i < counts.size() ? ", not " + quoted_ascii(counts[i].text) : std::string();
      cannot_read(name, fmt::format("{}: the numbers of vertices and faces are missing, two whole "
                                    "numbers of 0 or more{}",
                                    lines.name(), found));
    }
    return static_cast<std::size_t>(value);
  };
  header.vertices = count(0);
  header.faces = count(1);
  return header;
}

void read_vertex(const std::vector<Token>& tokens, bool has_normals, Layout& layout,
                 const Location& where) {
  const std::span<const Token> words(tokens);
  if (words.size() < (has_normals ? 6u : 3u)) {
    where.reject(
        fmt::format("it has {} numbers instead of {} or more", words.size(), has_normals ? 6 : 3));
  }
  append(layout.positions, words.first(3), where, Allowed::kMissing);
  if (!has_normals) return;
  append(layout.normals, words.subspan(3, 3), where, Allowed::kAny);
  const std::size_t end = words.size() > 6 ? words[6].at : words[5].at + words[5].text.size();
  layout.normal_traces.push_back({words[3].at, end - words[3].at});
}

std::vector<int> read_face(const std::vector<Token>& words, std::size_t vertices,
                           const Location& where) {
  const auto corners =
      static_cast<std::size_t>(std::max<std::int64_t>(to_integer(words[0].text).value_or(0), 0));
  if (corners == 0 || corners >= words.size()) {
    where.reject("it needs a number of corners and as many vertices after it");
  }
  std::vector<int> face(corners);
  for (std::size_t c = 0; c < corners; ++c) {
    const std::string_view word = words[c + 1].text;
    const std::int64_t vertex = to_integer(word).value_or(-1);
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices)) {
      where.reject(
          fmt::format("there is no vertex {}, only 0 to {}", quoted_ascii(word), vertices - 1));
    }
    face[c] = static_cast<int>(vertex);
  }
  return face;
}

}  // namespace

ShapeFile read_off(std::string_view bytes, const std::string& name) {
  ShapeFile file;
  Lines lines(bytes);
  const Header header = read_header(lines, file.layout, name);
  if (header.vertices == 0) cannot_read(name, "it has no vertices");
  std::size_t vertices = 0;
  for (; vertices < header.vertices && lines.next(); ++vertices) {
    read_vertex(lines.tokens(), header.has_normals, file.layout,
                {name, "vertex", vertices, lines.number()});
  }
  std::vector<std::vector<int>>& faces = file.shape.faces;
  while (faces.size() < header.faces && lines.next()) {
    faces.push_back(
        read_face(lines.tokens(), vertices, {name, "face", faces.size(), lines.number()}));
  }
  if (vertices < header.vertices || faces.size() < header.faces) {
    cannot_read(name, fmt::format("it announces {} vertices and {} faces, but ends after {} and {}",
                                  header.vertices, header.faces, vertices, faces.size()));
  }
  std::size_t further = 0;
  while (lines.next()) ++further;
  if (further > 0) {
    file.notes.push_back(fmt::format("{} lines after the last face are kept as they are", further));
  }
  take_points(file, name);
  return file;
}

std::string print_off(const Shape& shape) {
  const bool has_normals = shape.N.cols() > 0;
  std::string text =
      fmt::format("{}OFF\n{} {} 0\n", has_normals ? "N" : "", shape.V.cols(), shape.faces.size());
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_column(text, shape.V, i);
    if (has_normals) append_column(text += ' ', shape.N, i);
    text += '\n';
  }
  for (const auto& face : shape.faces) {
    fmt::format_to(std::back_inserter(text), "{}", face.size());
    for (const int v : face) fmt::format_to(std::back_inserter(text), " {}", v);
    text += '\n';
  }
  return text;
}

}  // namespace deformlab::formats
