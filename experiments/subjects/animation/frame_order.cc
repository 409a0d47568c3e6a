#include "experiments/subjects/animation/frame_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "geometry/core/error.h"
#include "geometry/transfer/nearest_nodes.h"

namespace deformlab {
namespace {

// An edge jumps if it becomes this much longer than it was and than the mean edge was. No edge of a
// usual animation does so from one frame to the next. In another order, most edges join vertices
// that are far apart.
constexpr double kLonger = 5, kLongerThanMean = 3;
// The share of edges that may jump. Points of a point set have no edges that hold them together.
constexpr double kMostOfMesh = 0.05, kMostOfPoints = 0.5;

std::vector<std::vector<int>> sorted_faces(std::vector<std::vector<int>> faces) {
  for (std::vector<int>& face : faces) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  }
  std::ranges::sort(faces);
  return faces;
}

std::vector<std::array<int, 2>> edges_of(const std::vector<std::vector<int>>& faces) {
  std::vector<std::array<int, 2>> edges;
  for (const std::vector<int>& face : faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      const auto [a, b] = std::minmax(face[c], face[(c + 1) % face.size()]);
      edges.push_back({a, b});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<std::array<int, 2>> nearest_pairs(const Eigen::Matrix3Xd& V) {
  std::vector<std::array<int, 2>> pairs;
  if (V.cols() < 2) return pairs;
  NearestNodes nearest(V, 2);
  for (int i = 0; i < V.cols(); ++i) {
    int found[2];
    double distances[2];
    nearest.find(V.col(i), found, distances);
    pairs.push_back({i, found[0] == i ? found[1] : found[0]});
  }
  return pairs;
}

std::vector<double> lengths_of(const std::vector<std::array<int, 2>>& edges,
                               const Eigen::Matrix3Xd& V) {
  const double size = bounding_box_diagonal(V);
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) {
    lengths.push_back(size > 0 ? (V.col(a) - V.col(b)).norm() / size : 0);
  }
  return lengths;
}

}  // namespace

void FrameOrder::begin(const Shape& shape, FrameNumber frame) {
  first_ = frame;
  vertices_ = shape.V.cols();
  faces_ = sorted_faces(shape.faces);
  edges_ = faces_.empty() ? nearest_pairs(shape.V) : edges_of(faces_);
}

void FrameOrder::add(const Shape& shape, FrameNumber frame, const std::filesystem::path& path) {
  const std::string name = fmt::format("frame {}, '{}',", frame, path.string());
  if (!first_) begin(shape, frame);
  if (shape.V.cols() != vertices_) {
    throw InputError(fmt::format(
        "{} has {} vertices, but frame {} has {}; all frames of an animation must have the "
        "same number",
        name, shape.V.cols(), *first_, vertices_));
  }
  if (sorted_faces(shape.faces) != faces_) {
    throw InputError(fmt::format(
        "{} has other faces than frame {}, or its vertices come in another order; all frames of an "
        "animation must have the same faces and the same order of vertices: export them again, "
        "without an option that sorts, merges or triangulates anew",
        name, *first_));
  }
  check_lengths(shape, name);
  last_ = frame;
}

void FrameOrder::check_lengths(const Shape& shape, const std::string& name) {
  std::vector<double> now = lengths_of(edges_, shape.V);
  const double mean = std::reduce(lengths_.begin(), lengths_.end()) /
                      std::max<double>(1, static_cast<double>(lengths_.size()));
  std::size_t jumps = 0;
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    jumps += now[e] > kLonger * lengths_[e] && now[e] > kLongerThanMean * mean;
  }
  const double most = faces_.empty() ? kMostOfPoints : kMostOfMesh;
  if (static_cast<double>(jumps) > most * static_cast<double>(now.size())) {
    throw InputError(fmt::format(
        "{} seems to have its vertices in another order than frame {}: {} of {} {} are suddenly "
        "more "
        "than {:g} times as long; all frames of an animation must have the same order of vertices",
        name, last_, jumps, now.size(), faces_.empty() ? "distances between neighbours" : "edges",
        kLonger));
  }
  lengths_ = std::move(now);
}

}  // namespace deformlab
