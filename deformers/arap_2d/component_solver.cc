#include "deformers/arap_2d/component_solver.h"

#include <algorithm>
#include <utility>

#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Whether Schur complements are cheaper than elimination. Their time grows with the cube of the
// number of conditions, that of elimination a little more than with the number of vertices.
bool are_few(Eigen::Index conditions, Eigen::Index vertices) {
  return conditions * conditions * conditions <= 128 * vertices;
}

Triangulation submesh(const Triangulation& mesh, const MeshComponent& component) {
  std::vector<int> local(mesh.V.cols());
  for (int i = 0; i < std::ssize(component.vertices); ++i) local[component.vertices[i]] = i;
  Triangulation part{mesh.V(Eigen::all, component.vertices),
                     mesh.F(Eigen::all, component.triangles)};
  for (int& v : part.F.reshaped()) v = local[v];
  return part;
}

}  // namespace

ComponentSolver::ComponentSolver(const Triangulation& mesh, const Eigen::VectorXd& weights,
                                 MeshComponent component)
    : component_(std::move(component)),
      mesh_(std::make_unique<RegisteredMesh>(submesh(mesh, component_),
                                             weights(component_.triangles))),
      schur_complement_(make_schur_complement_system(*mesh_)),
      elimination_(make_elimination_system(*mesh_)),
      z_(mesh_->p) {
  for (const int i : mesh_->order) vertex_.push_back(component_.vertices[i]);
}

void ComponentSolver::reset() {
  mesh_->fit.reset();
  keeps_handles_ = false;
}

bool ComponentSolver::compile(const std::vector<BarycentricPoint>& points) {
  system_ = nullptr;
  if (!std::exchange(keeps_handles_, true)) {
    schur_complement_ = make_schur_complement_system(*mesh_);
  }
  target_ = points_inside(component_, points);
  q_.resize(std::ssize(target_));
  const std::vector<int>& own = component_.vertices;
  points_.clear();
  for (const int i : target_) {
    points_.push_back(points[i]);
    for (int& v : points_.back().vertices) {
      v = mesh_->index[std::lower_bound(own.begin(), own.end(), v) - own.begin()];
    }
  }
  MeshHandles handles{points_, cluster_handles(points_), false};
  const Eigen::Index rank = handles.rank();
  handles.distinct = rank > 1 && are_distinct(points_, mesh_->p, mesh_->extent);
  motion_ = motion_of(!points_.empty(), handles.distinct);
  if (rank <= 1) return true;
  system_ = are_few(rank, mesh_->p.size()) ? schur_complement_.get() : elimination_.get();
  system_->compile(handles);
  return system_ == schur_complement_.get();
}

// The rest shape, translated by the mean displacement of the handles.
Eigen::VectorXcd ComponentSolver::translated() const {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) sum += q_[i] - points_[i](mesh_->p);
  return mesh_->p.array() + sum / static_cast<double>(points_.size());
}

void ComponentSolver::update(const Eigen::Matrix2Xd& targets, int refinements,
                             TwoStepSolver::Seconds& seconds, Eigen::Matrix2Xd& V) {
  if (motion_ == ComponentMotion::kNone) return;
  origin_ = targets.col(target_[0]);
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    const Eigen::Vector2d q = targets.col(target_[i]) - origin_;
    q_[i] = {q.x(), q.y()};
  }
  refined_ = false;
  if (motion_ == ComponentMotion::kDeformation) {
    deform(refinements, seconds);
  } else if (system_ != nullptr) {
    mesh_->fit.assemble(z_);
    system_->step_two(q_, z_);
  } else {
    z_ = translated();
  }
  write(z_, V);
}

void ComponentSolver::deform(int refinements, TwoStepSolver::Seconds& seconds) {
  {
    Stopwatch watch(seconds.step_one);
    system_->step_one(q_);
  }
  {
    Stopwatch watch(seconds.fit);
    mesh_->fit.fit(system_->intermediate(), z_);
  }
  Stopwatch watch(seconds.step_two);
  system_->step_two(q_, z_);
  refined_ = refinements > 0;
  for (int i = 0; i < refinements; ++i) {
    fitted_to_ = z_;
    mesh_->fit.fit(fitted_to_, z_);
    system_->step_two(q_, z_);
  }
}

void ComponentSolver::write(const Eigen::VectorXcd& z, Eigen::Matrix2Xd& V) const {
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    V(0, vertex_[i]) = z[i].real() + origin_.x();
    V(1, vertex_[i]) = z[i].imag() + origin_.y();
  }
}

Eigen::VectorXcd ComponentSolver::intermediate() const {
  return motion_ == ComponentMotion::kDeformation ? system_->intermediate() : translated();
}

void ComponentSolver::write_intermediate(Eigen::Matrix2Xd& intermediate) const {
  if (motion_ != ComponentMotion::kNone) write(this->intermediate(), intermediate);
}

void ComponentSolver::write_fitted(Eigen::Matrix2Xd& fitted) const {
  if (motion_ == ComponentMotion::kNone) return;
  const Eigen::Matrix2Xd corners =
      mesh_->fit.corners(refined_ ? fitted_to_ : intermediate()).colwise() + origin_;
  for (int f = 0; f < std::ssize(component_.triangles); ++f) {
    fitted.middleCols<3>(3 * component_.triangles[f]) = corners.middleCols<3>(3 * f);
  }
}

}  // namespace deformlab
