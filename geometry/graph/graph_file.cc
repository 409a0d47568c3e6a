#include "geometry/graph/graph_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"

namespace deformlab {
namespace {

class Reader {
 public:
  Reader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  DeformationGraph run() {
    for (Lines lines(bytes_, true); lines.next();) {
      const std::string_view keyword = lines.tokens()[0].text;
      if (keyword == "v") node(lines);
      if (keyword == "l") polyline(lines);
      if (keyword == "f") {
        cannot_read(name_, lines.name() + ": a face is no edge of a graph; join nodes by l lines");
      }
    }
    if (nodes_.empty()) cannot_read(name_, "it has no node, which is a line 'v x y z'");
    return graph();
  }

 private:
  struct Node {
    Eigen::Vector3d g;
    std::string line;
    bool joined = false;
  };
  struct Ends {
    std::int64_t from, to;  // indices that count from 1
    std::string line;
  };

  void node(const Lines& lines) {
    const std::span<const Token> words(lines.tokens());
    const std::string owner = called(nodes_.size() + 1) + " (" + lines.name() + ")";
    if (words.size() < 4) cannot_read(name_, owner + " has fewer than 3 coordinates");
    Node& node = nodes_.emplace_back();
    for (int row = 0; row < 3; ++row) node.g[row] = coordinate(words[row + 1], owner) + 0.0;
    check_distance(node.g, owner);
    node.line = lines.name();
    const auto [first, is_new] =
        places_.try_emplace({node.g.x(), node.g.y(), node.g.z()}, nodes_.size());
    if (is_new) return;
    cannot_read(name_, owner + " is repeated: " + called(first->second) + " (" +
                           nodes_[first->second - 1].line +
                           ") is at the same place; leave one out");
  }

  double coordinate(const Token& word, const std::string& owner) const {
    const std::optional<double> value = to_number(word.text);
    if (!value) cannot_read(name_, owner + ": " + quoted_ascii(word.text) + " is not a number");
    if (!std::isfinite(*value)) {
      cannot_read(name_, owner + ": " + quoted_ascii(word.text) + " is not finite");
    }
    return *value;
  }

  void check_distance(const Eigen::Vector3d& g, const std::string& owner) const {
    if (g.cwiseAbs().maxCoeff() <= kMostLength) return;
    cannot_read(name_, fmt::format("{} is at ({:.6g} {:.6g} {:.6g}); coordinates may be up to {:g}",
                                   owner, g.x(), g.y(), g.z(), kMostLength));
  }

  void polyline(const Lines& lines) {
    const std::span<const Token> words(lines.tokens());
    if (words.size() < 3) cannot_read(name_, lines.name() + ": an edge joins two nodes or more");
    for (std::size_t w = 2; w < words.size(); ++w) {
      ends_.push_back({index(words[w - 1], lines), index(words[w], lines), lines.name()});
    }
  }

  // Returns an index that counts from 1. Whether the node exists is checked at the end of the file.
  std::int64_t index(const Token& word, const Lines& lines) const {
    const auto value = to_integer(word.text.substr(0, word.text.find('/')));
    constexpr std::int64_t kMost = std::numeric_limits<int>::max();
    if (!value || *value == 0 || *value > kMost || *value < -kMost) {
      cannot_read(name_,
                  fmt::format("{}: {} is not a node; nodes count from 1, or backwards from -1",
                              lines.name(), quoted_ascii(word.text)));
    }
    if (-*value > std::ssize(nodes_)) {
      cannot_read(name_, fmt::format("{}: an edge to {} leads nowhere: so far there are {} nodes",
                                     lines.name(), quoted_ascii(word.text), nodes_.size()));
    }
    return *value > 0 ? *value : std::ssize(nodes_) + 1 + *value;
  }

  static std::string called(std::size_t node) { return "node " + std::to_string(node); }

  void check(const Ends& e) const {
    for (const std::int64_t end : {e.from, e.to}) {
      if (end >= 1 && end <= std::ssize(nodes_)) continue;
      cannot_read(name_,
                  fmt::format("{}: the edge from node {} to node {} leads nowhere: there are {} "
                              "nodes, counted from 1",
                              e.line, e.from, e.to, nodes_.size()));
    }
    if (e.from == e.to) {
      cannot_read(name_,
                  e.line + ": the edge joins " + called(e.from) + " to itself; leave it out");
    }
  }

  DeformationGraph graph() {
    std::map<std::pair<int, int>, std::string> edges;  // with the line of each
    for (const Ends& e : ends_) {
      check(e);
      const auto [lo, hi] = std::minmax({static_cast<int>(e.from), static_cast<int>(e.to)});
      const auto [first, is_new] = edges.try_emplace({lo - 1, hi - 1}, e.line);
      if (!is_new) {
        cannot_read(name_, e.line + ": the edge between " + called(lo) + " and " + called(hi) +
                               " is repeated: " + first->second + " has it; leave one out");
      }
      nodes_[lo - 1].joined = nodes_[hi - 1].joined = true;
    }
    DeformationGraph result{Eigen::Matrix3Xd(3, std::ssize(nodes_)), {}};
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      if (!nodes_[j].joined && nodes_.size() > 1) {
        cannot_read(name_,
                    called(j + 1) + " (" + nodes_[j].line +
                        ") is isolated: no edge has it; join it to another, or leave it out");
      }
      result.g.col(static_cast<Eigen::Index>(j)) = nodes_[j].g;
    }
    for (const auto& [ends, line] : edges) result.edges.push_back({ends.first, ends.second, 1});
    return result;
  }

  std::string_view bytes_;
  std::string name_;
  std::vector<Node> nodes_;
  std::vector<Ends> ends_;
  std::map<std::tuple<double, double, double>, std::size_t> places_;  // with the node's number
};

}  // namespace

DeformationGraph read_graph(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return Reader(bytes, path.string()).run();
}

}  // namespace deformlab
