#include "deformers/arap_2d/mesh_part.h"

#include <algorithm>
#include <utility>

#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr int kFewPlaces = 16;       // up to so many are cheaper to add than to eliminate
constexpr double kSamePlace = 1e-9;  // of the extent
constexpr int kMostNamed = 5;        // components in the notes

Triangulation submesh(const Triangulation& mesh, const MeshComponent& component) {
  std::vector<int> local(mesh.V.cols());
  for (int i = 0; i < std::ssize(component.vertices); ++i) local[component.vertices[i]] = i;
  Triangulation part{mesh.V(Eigen::all, component.vertices),
                     mesh.F(Eigen::all, component.triangles)};
  for (int& v : part.F.reshaped()) v = local[v];
  return part;
}

std::string name(const MeshComponent& component) {
  return "a part of the mesh (" + std::to_string(component.vertices.size()) +
         " vertices, the first is vertex " + std::to_string(component.vertices.front()) + ")";
}

}  // namespace

void HoldNotes::add(const MeshComponent& component, Hold hold) {
  if (hold == Hold::kShape) return;
  if (std::ssize(named_) == kMostNamed) {
    ++others_;
  } else if (hold == Hold::kFree) {
    named_.push_back(name(component) + " has no handle: it stays where it is");
  } else {
    named_.push_back(name(component) +
                     " is held at one point only: it moves there without turning");
  }
}

std::vector<std::string> HoldNotes::notes() const {
  std::vector<std::string> result = named_;
  if (others_ > 0) {
    result.push_back("parts of the mesh with fewer than two handles, besides these: " +
                     std::to_string(others_));
  }
  return result;
}

bool differ(const std::vector<BarycentricPoint>& places, const Eigen::VectorXcd& p) {
  const double extent = (p.array() - p[0]).abs().maxCoeff();
  return std::any_of(places.begin(), places.end(), [&](const BarycentricPoint& place) {
    return std::abs(place(p) - places[0](p)) > kSamePlace * extent;
  });
}

MeshPart::MeshPart(const Triangulation& mesh, const Eigen::VectorXd& weights,
                   MeshComponent component)
    : component_(std::move(component)),
      mesh_(std::make_unique<RegisteredMesh>(submesh(mesh, component_),
                                             weights(component_.triangles))),
      z_(mesh_->p) {
  for (const int i : mesh_->vertex) vertex_.push_back(component_.vertices[i]);
}

void MeshPart::compile(const std::vector<BarycentricPoint>& places) {
  index_.clear(), places_.clear();
  system_ = nullptr;
  const std::vector<int>& own = component_.vertices;
  for (int i = 0; i < std::ssize(places); ++i) {
    const auto at = [&](int v) { return std::lower_bound(own.begin(), own.end(), v); };
    const auto first = at(places[i].vertices[0]);
    if (first == own.end() || *first != places[i].vertices[0]) continue;
    index_.push_back(i);
    places_.push_back(places[i]);
    for (int& v : places_.back().vertices) {
      v = mesh_->place[at(v) - own.begin()];
    }
  }
  q_.resize(std::ssize(places_));
  Held held{places_, clusters(places_, mesh_->p.size()), false};
  Eigen::Index rank = 0;
  for (const Cluster& cluster : held.clusters) rank += cluster.rank();
  held.turns = turns_ = rank > 1 && differ(places_, mesh_->p);
  hold_ = places_.empty() ? Hold::kFree : turns_ ? Hold::kShape : Hold::kPoint;
  if (rank > 1) {
    system_ = rank <= kFewPlaces ? make_few_held(*mesh_, held) : make_many_held(*mesh_, held);
  }
}

// The rest shape, moved to where the targets are on the mean.
Eigen::VectorXcd MeshPart::carried() const {
  std::complex<double> move = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) move += q_[i] - places_[i](mesh_->p);
  return mesh_->p.array() + move / static_cast<double>(places_.size());
}

void MeshPart::update(const Eigen::Matrix2Xd& targets, int refinements,
                      TwoStepSolver::Seconds& seconds, Eigen::Matrix2Xd& V) {
  if (hold_ == Hold::kFree) return;
  origin_ = targets.col(index_[0]);
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    const Eigen::Vector2d q = targets.col(index_[i]) - origin_;
    q_[i] = {q.x(), q.y()};
  }
  if (system_ != nullptr) {
    {
      Stopwatch watch(seconds.step_one);
      system_->step_one(q_);
    }
    {
      Stopwatch watch(seconds.fit);
      system_->fit(mesh_->fit);
    }
    Stopwatch watch(seconds.step_two);
    for (int i = 0; i <= (turns_ ? refinements : 0); ++i) {
      if (i > 0) mesh_->fit.fit(z_);
      mesh_->fit.assemble(z_);
      system_->step_two(q_, z_);
    }
  } else {
    z_ = carried();
  }
  write(z_, V);
}

void MeshPart::write(const Eigen::VectorXcd& z, Eigen::Matrix2Xd& V) const {
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    V(0, vertex_[i]) = z[i].real() + origin_.x();
    V(1, vertex_[i]) = z[i].imag() + origin_.y();
  }
}

void MeshPart::write_stages(Eigen::Matrix2Xd& intermediate, Eigen::Matrix2Xd& fitted) const {
  if (hold_ == Hold::kFree) return;
  const Eigen::VectorXcd z = turns_ ? system_->intermediate() : carried();
  write(z, intermediate);
  const Eigen::Matrix2Xd corners = mesh_->fit.corners(z).colwise() + origin_;
  for (int f = 0; f < std::ssize(component_.triangles); ++f) {
    fitted.middleCols<3>(3 * component_.triangles[f]) = corners.middleCols<3>(3 * f);
  }
}

}  // namespace deformlab
