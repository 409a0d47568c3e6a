#include "deformers/arap_2d/closed_form_steps.h"

#include <utility>

#include "deformers/arap_2d/rest_mesh_check.h"

namespace deformlab {

ClosedFormSteps::ClosedFormSteps(const Triangulation& mesh, const Eigen::VectorXd& weights,
                                 int refinements)
    : mesh_(mesh), refinements_(refinements), V_(mesh.V) {
  check_rest_mesh(mesh, weights);
  for (MeshComponent& component : components(mesh)) {
    components_.emplace_back(mesh, weights, std::move(component));
  }
}

void ClosedFormSteps::compile(const std::vector<BarycentricPoint>& points) {
  MotionNotes motions;
  bool adapts = std::exchange(compiled_, true);
  for (ComponentSolver& solver : components_) {
    adapts = solver.compile(points) && adapts;
    motions.add(solver.component(), solver.motion());
    if (solver.motion() != ComponentMotion::kNone) continue;
    const std::vector<int>& own = solver.component().vertices;
    V_(Eigen::all, own) = mesh_.V(Eigen::all, own);
  }
  compilations_ += !adapts;
  notes_ = motions.notes();
}

void ClosedFormSteps::update(const Eigen::Matrix2Xd& targets) {
  seconds_ = {};
  for (ComponentSolver& solver : components_) solver.update(targets, refinements_, seconds_, V_);
}

void ClosedFormSteps::reset() {
  compiled_ = false;
  for (ComponentSolver& solver : components_) solver.reset();
  V_ = mesh_.V;
}

Eigen::Matrix2Xd ClosedFormSteps::intermediate() const {
  Eigen::Matrix2Xd result = mesh_.V;
  for (const ComponentSolver& solver : components_) solver.write_intermediate(result);
  return result;
}

Eigen::Matrix2Xd ClosedFormSteps::fitted() const {
  Eigen::Matrix2Xd result = mesh_.V(Eigen::all, mesh_.F.reshaped());
  for (const ComponentSolver& solver : components_) solver.write_fitted(result);
  return result;
}

Summary ClosedFormSteps::summary() const {
  Summary summary;
  summary.status = Status::kConverged;
  summary.message = "closed form";
  summary.method = "closed_form";
  summary.unknowns = 2 * static_cast<int>(V_.cols());
  for (const ComponentSolver& solver : components_) summary.nonzeros_factor += solver.nonzeros();
  summary.seconds = seconds_.by_name();
  return summary;
}

}  // namespace deformlab
