#include "experiments/scenes/surface_nets.h"

#include <array>
#include <cmath>
#include <utility>

namespace deformlab {
namespace {

using Cell = Eigen::Vector3i;

constexpr int kMostSweeps = 20;

// Whether corners of a cube, given as bits, are connected along the edges of the cube.
bool is_one_piece(unsigned corners) {
  unsigned reached = corners & -corners;
  for (int step = 0; step < 8; ++step) {
    unsigned around = reached;
    for (int c = 0; c < 8; ++c) {
      if (reached >> c & 1) around |= 1U << (c ^ 1) | 1U << (c ^ 2) | 1U << (c ^ 4);
    }
    reached = around & corners;
  }
  return reached == corners;
}

Cell corner_of(const Cell& cube, int c) { return cube + Cell(c & 1, c >> 1 & 1, c >> 2 & 1); }

class Net {
 public:
  Net(const std::function<double(const Eigen::Vector3d&)>& inside, const Eigen::Vector3d& low,
      const Eigen::Vector3d& high, double cell)
      : low_(low), cell_(cell) {
    size_ = ((high - low) / cell).array().ceil().cast<int>() + 1;
    values_.resize(std::size_t(size_.x()) * size_.y() * size_.z());
    for (int z = 0; z < size_.z(); ++z) {
      for (int y = 0; y < size_.y(); ++y) {
        for (int x = 0; x < size_.x(); ++x) values_[index({x, y, z})] = inside(at({x, y, z}));
      }
    }
    vertex_.assign(values_.size(), -1);
    for (int sweep = 0; sweep < kMostSweeps && separate_sheets(); ++sweep) {
    }
  }

  Shape run() {
    for (int z = 1; z + 1 < size_.z(); ++z) {
      for (int y = 1; y + 1 < size_.y(); ++y) {
        for (int x = 1; x + 1 < size_.x(); ++x) {
          for (int axis = 0; axis < 3; ++axis) add_quad({x, y, z}, axis);
        }
      }
    }
    Shape shape;
    shape.V.resize(3, std::ssize(vertices_));
    for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
      shape.V.col(i) = vertices_[static_cast<std::size_t>(i)];
    }
    shape.faces = std::move(faces_);
    return shape;
  }

 private:
  std::size_t index(const Cell& c) const {
    return (std::size_t(c.z()) * size_.y() + c.y()) * size_.x() + c.x();
  }
  double value(const Cell& c) const { return values_[index(c)]; }
  Eigen::Vector3d at(const Cell& c) const { return low_ + cell_ * c.cast<double>(); }

  // A cube has one vertex, at which two sheets through the cube would touch. Therefore the corner
  // that is nearest to the surface changes sides if there are two.
  bool separate_sheets() {
    bool changed = false;
    for (int z = 0; z + 1 < size_.z(); ++z) {
      for (int y = 0; y + 1 < size_.y(); ++y) {
        for (int x = 0; x + 1 < size_.x(); ++x) changed = separate({x, y, z}) || changed;
      }
    }
    return changed;
  }

  bool separate(const Cell& cube) {
    unsigned inside = 0;
    for (int c = 0; c < 8; ++c) inside |= unsigned(value(corner_of(cube, c)) < 0) << c;
    if (is_one_piece(inside) && is_one_piece(~inside & 0xFF)) return false;
    double* nearest = nullptr;
    for (int c = 0; c < 8; ++c) {
      double& there = values_[index(corner_of(cube, c))];
      if (!nearest || std::abs(there) < std::abs(*nearest)) nearest = &there;
    }
    *nearest = *nearest == 0 ? -1e-9 * cell_ : -*nearest;
    return true;
  }

  // Adds the quad around the edge of the grid from c along an axis, if the surface crosses the
  // edge.
  void add_quad(const Cell& c, int axis) {
    const bool begins_inside = value(c) < 0, ends_inside = value(c + Cell::Unit(axis)) < 0;
    if (begins_inside == ends_inside) return;
    const Cell u = Cell::Unit((axis + 1) % 3), v = Cell::Unit((axis + 2) % 3);
    std::array<Cell, 4> cells{c - u - v, c - v, c, c - u};
    if (!begins_inside) std::swap(cells[1], cells[3]);
    std::vector<int> face;
    for (const Cell& around : cells) face.push_back(vertex_in(around));
    faces_.push_back(std::move(face));
  }

  int vertex_in(const Cell& c) {
    int& vertex = vertex_[index(c)];
    if (vertex >= 0) return vertex;
    vertex = static_cast<int>(vertices_.size());
    vertices_.push_back(mean_of_crossings(c));
    return vertex;
  }

  Eigen::Vector3d mean_of_crossings(const Cell& c) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int crossings = 0;
    for (int edge = 0; edge < 12; ++edge) {
      const int axis = edge / 4;
      const Cell from = c + (edge & 1) * Cell::Unit((axis + 1) % 3) +
                        (edge >> 1 & 1) * Cell::Unit((axis + 2) % 3);
      const double a = value(from), b = value(from + Cell::Unit(axis));
      if ((a < 0) == (b < 0)) continue;
      sum += at(from) + cell_ * a / (a - b) * Eigen::Vector3d::Unit(axis);
      ++crossings;
    }
    return sum / crossings;
  }

  Eigen::Vector3d low_;
  double cell_;
  Eigen::Array3i size_;
  std::vector<double> values_;  // at the corners of all cubes
  std::vector<int> vertex_;     // the vertex of the cube that begins at each corner, or -1
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::vector<int>> faces_;
};

}  // namespace

Shape surface_nets(const std::function<double(const Eigen::Vector3d&)>& inside,
                   const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell) {
  return Net(inside, low, high, cell).run();
}

}  // namespace deformlab
