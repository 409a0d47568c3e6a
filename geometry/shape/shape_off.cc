#include <algorithm>

#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

struct Header {
  std::size_t vertices = 0, faces = 0;
  bool has_normals = false;
};

/// [ST][C][N]OFF in whatever order the letters stand.
void read_keyword(const std::vector<Token>& tokens, Scan& scan, Header& header,
                  const std::string& name) {
  std::string letters(tokens[0].text);
  if (!letters.ends_with("OFF")) reject(name, "it does not begin with OFF, COFF, NOFF or the like");
  letters.resize(letters.size() - 3);
  if (letters.find_first_not_of("STCN") != std::string::npos ||
      (tokens.size() > 1 && tokens[1].text == "BINARY")) {
    reject(name,
           "of the OFF formats only the text ones with three coordinates are known: "
           "OFF with C, N or ST before it; write it as one of these, or as PLY");
  }
  const std::size_t n = letters.find('N');
  header.has_normals = n != std::string::npos;
  if (header.has_normals) scan.layout.normal_traces.push_back({tokens[0].at + n, 1});
}

Header read_header(Lines& lines, Scan& scan, const std::string& name) {
  Header header;
  if (!lines.next()) reject(name, "it is empty");
  read_keyword(lines.tokens(), scan, header, name);
  std::span<const Token> counts(lines.tokens());
  counts = counts.subspan(1);
  if (counts.empty() && lines.next()) counts = lines.tokens();
  const auto count = [&](std::size_t i) {
    const std::optional<std::int64_t> value =
        i < counts.size() ? to_integer(counts[i].text) : std::nullopt;
    if (!value || *value < 0) reject(name, "the numbers of vertices and faces are missing");
    return static_cast<std::size_t>(*value);
  };
  header.vertices = count(0);
  header.faces = count(1);
  return header;
}

void read_vertex(const Lines& lines, bool has_normals, Scan& scan, const std::string& name) {
  const std::span<const Token> words(lines.tokens());
  const std::string owner = lines.owner("vertex", scan.vertices);
  if (words.size() < (has_normals ? 6u : 3u)) {
    reject(name, owner + ": it has " + std::to_string(words.size()) + " numbers instead of " +
                     (has_normals ? "6" : "3") + " or more");
  }
  append(scan.layout.positions, words.first(3), name, owner);
  for (const Token& word : words.first(3)) scan.plain.append(word.text) += ' ';
  scan.plain.back() = '\n';
  ++scan.vertices;
  if (!has_normals) return;
  append(scan.layout.normals, words.subspan(3, 3), name, owner);
  const std::size_t end = words.size() > 6 ? words[6].at : words[5].at + words[5].text.size();
  scan.layout.normal_traces.push_back({words[3].at, end - words[3].at});
}

void read_face(const Lines& lines, Scan& scan, const std::string& name) {
  const std::span<const Token> words(lines.tokens());
  const std::string owner = lines.owner("face", scan.faces);
  const auto corners =
      static_cast<std::size_t>(std::max<std::int64_t>(to_integer(words[0].text).value_or(0), 0));
  if (corners == 0 || corners >= words.size()) {
    reject(name, owner + ": it needs a number of corners and as many vertices after it");
  }
  scan.plain += std::to_string(corners);
  for (const Token& word : words.subspan(1, corners)) {
    const std::int64_t vertex = to_integer(word.text).value_or(-1);
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(scan.vertices)) {
      reject(name, owner + ": there is no vertex " + quoted(word.text) + ", only 0 to " +
                       std::to_string(scan.vertices - 1));
    }
    scan.plain.append(" ").append(std::to_string(vertex));
  }
  scan.plain += '\n';
  ++scan.faces;
}

}  // namespace

Scan scan_off(std::string_view bytes, const std::string& name) {
  Scan scan;
  Lines lines(bytes);
  const Header header = read_header(lines, scan, name);
  if (header.vertices == 0) reject(name, "it has no vertices");
  scan.plain =
      "OFF\n" + std::to_string(header.vertices) + " " + std::to_string(header.faces) + " 0\n";
  while (scan.vertices < header.vertices && lines.next()) {
    read_vertex(lines, header.has_normals, scan, name);
  }
  while (scan.faces < header.faces && lines.next()) read_face(lines, scan, name);
  if (scan.vertices < header.vertices || scan.faces < header.faces) {
    reject(name, "it announces " + std::to_string(header.vertices) + " vertices and " +
                     std::to_string(header.faces) + " faces, but ends after " +
                     std::to_string(scan.vertices) + " and " + std::to_string(scan.faces));
  }
  return scan;
}

std::string print_off(const Shape& shape) {
  const bool has_normals = shape.N.cols() > 0;
  std::string text = has_normals ? "NOFF\n" : "OFF\n";
  text += std::to_string(shape.V.cols()) + " " + std::to_string(shape.faces.size()) + " 0\n";
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_column(text, shape.V, i);
    if (has_normals) append_column(text += ' ', shape.N, i);
    text += '\n';
  }
  for (const auto& face : shape.faces) {
    text += std::to_string(face.size());
    for (const int v : face) text.append(" ").append(std::to_string(v));
    text += '\n';
  }
  return text;
}

}  // namespace deformlab::formats
