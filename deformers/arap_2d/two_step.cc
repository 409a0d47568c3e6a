#include "deformers/arap_2d/two_step.h"

#include <utility>

#include "deformers/arap_2d/connectivity.h"

namespace deformlab {

TwoStep::TwoStep(const Triangulation& mesh, const Eigen::VectorXd& weights, int refinements)
    : mesh_(mesh), refinements_(refinements), V_(mesh.V) {
  check(mesh, weights);
  for (MeshComponent& component : components(mesh)) {
    parts_.emplace_back(mesh, weights, std::move(component));
  }
}

void TwoStep::compile(const std::vector<BarycentricPoint>& places) {
  HoldNotes holds;
  for (MeshPart& part : parts_) {
    part.compile(places);
    holds.add(part.component(), part.hold());
    const std::vector<int>& own = part.component().vertices;
    if (part.hold() == Hold::kFree) V_(Eigen::all, own) = mesh_.V(Eigen::all, own);
  }
  notes_ = holds.notes();
}

void TwoStep::update(const Eigen::Matrix2Xd& targets) {
  seconds_ = {};
  for (MeshPart& part : parts_) part.update(targets, refinements_, seconds_, V_);
}

void TwoStep::reset() {
  for (MeshPart& part : parts_) part.reset();
  V_ = mesh_.V;
}

TwoStep::Stages TwoStep::stages() const {
  Stages result{mesh_.V, mesh_.V(Eigen::all, mesh_.F.reshaped())};
  for (const MeshPart& part : parts_) part.write_stages(result.intermediate, result.fitted);
  return result;
}

Eigen::Matrix2Xd TwoStep::intermediate() const { return stages().intermediate; }
Eigen::Matrix2Xd TwoStep::fitted() const { return stages().fitted; }

Summary TwoStep::summary() const {
  Summary summary;
  summary.status = Status::kConverged;
  summary.message = "closed form";
  summary.method = "closed_form";
  summary.unknowns = 2 * static_cast<int>(V_.cols());
  for (const MeshPart& part : parts_) summary.nonzeros_factor += part.nonzeros();
  summary.seconds = {{"step_one", seconds_.step_one},
                     {"fit", seconds_.fit},
                     {"step_two", seconds_.step_two},
                     {"total", seconds_.step_one + seconds_.fit + seconds_.step_two}};
  return summary;
}

}  // namespace deformlab
