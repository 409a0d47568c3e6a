#include "deformers/baselines/primo_deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/baselines/prism_solver.h"
#include "deformers/baselines/surface.h"
#include "deformers/handle_checks.h"
#include "geometry/core/disjoint_sets.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSamePosition = 1e-6;  // a smaller distance counts as 0 [mean side]
// Twice the least area of a triangle whose corners determine the rotation of its prism [square of
// its longest side].
constexpr double kThinnest = 1e-6;

}  // namespace

PrimoDeformation::PrimoDeformation(Shape rest, const PrimoOptions& options)
    : Baseline(std::move(rest)), options_(options) {
  check_options(options_);
  {
    Stopwatch watch(seconds_["register"]);
    baselines::Surface surface = baselines::surface_of(rest_, "PriMo");
    unit_ = mean_side(rest_.V, surface.T);
    V_ = rest_.V / unit_;
    prisms_ = make_prisms(V_, surface.T, options_.height * bounding_box_diagonal(V_));
    motions_ = RigidMotions::at_rest(prisms_);
    registration_notes_ = std::move(surface.notes);
  }
  compile({});
}

void PrimoDeformation::reset() {
  motions_ = RigidMotions::at_rest(prisms_);
  deformed_ = rest_;
}

void PrimoDeformation::check_supported(const Handles& handles) const {
  baselines::refuse_points(handles, "PriMo");
}

void PrimoDeformation::compile_handles() {
  choose_prescribed();
  std::vector<Pin> pins = make_pins();
  const std::vector<char> fixed = fix_free_components(pins);
  equations_ = std::make_unique<PrismEquations>(prisms_, std::move(pins), fixed);
}

void PrimoDeformation::choose_prescribed() {
  handle_of_.assign(V_.cols(), -1);
  int column = 0;
  for (const auto* indices : {&handles_.fixed, &handles_.moved}) {
    for (const int v : *indices) handle_of_[v] = column++;
  }
  prescribed_.assign(prisms_.T.cols(), 0);
  on_prescribed_.assign(V_.cols(), 0);
  for (Eigen::Index i = 0; i < prisms_.T.cols(); ++i) {
    const Eigen::Vector3i corners = prisms_.T.col(i);
    const auto is_handle = [&](int v) { return handle_of_[v] >= 0; };
    if (!std::all_of(corners.begin(), corners.end(), is_handle)) continue;
    if (baselines::is_thin(V_(Eigen::all, corners), kThinnest)) continue;
    prescribed_[i] = 1;
    for (const int v : corners) on_prescribed_[v] = 1;
  }
}

std::vector<Pin> PrimoDeformation::make_pins() const {
  std::vector<Pin> pins;
  for (int i = 0; i < prisms_.T.cols(); ++i) {
    for (const int v : prisms_.T.col(i)) {
      if (handle_of_[v] < 0 || on_prescribed_[v]) continue;
      pins.push_back({i, handle_of_[v], options_.handle_weight, V_.col(v), V_.col(v)});
    }
  }
  return pins;
}

// Returns for each prism whether it is fixed. Prescribed prisms are fixed, and so are components
// without a handle, which could move anywhere at no cost. Also finds the components that are pinned
// at one point.
std::vector<char> PrimoDeformation::fix_free_components(const std::vector<Pin>& pins) {
  const int m = static_cast<int>(prisms_.T.cols());
  DisjointSets sets(m);
  for (const Joint& joint : prisms_.joints) sets.join(joint.i, joint.j);
  const std::vector<int> component = sets.numbered();
  const int components = 1 + std::ranges::max(component);

  // For each component kFree, kAnchored, or one of its pins where all of them are at one point.
  constexpr int kFree = -1, kAnchored = -2;
  std::vector<int> pin_of(components, kFree);
  for (int k = 0; k < std::ssize(pins); ++k) {
    int& pin = pin_of[component[pins[k].i]];
    if (pin == kFree) pin = k;
    if (pin >= 0 && (pins[pin].p - pins[k].p).norm() > kSamePosition) pin = kAnchored;
  }
  for (int i = 0; i < m; ++i) {
    if (prescribed_[i]) pin_of[component[i]] = kAnchored;
  }
  std::vector<char> fixed = prescribed_;
  at_one_point_.clear();
  std::vector<int> index(components, -1);
  for (int i = 0; i < m; ++i) {
    const int c = component[i];
    if (pin_of[c] == kFree) fixed[i] = 1;
    if (pin_of[c] < 0) continue;
    if (index[c] < 0) {
      index[c] = static_cast<int>(at_one_point_.size());
      at_one_point_.push_back({{}, pin_of[c]});
    }
    at_one_point_[index[c]].prisms.push_back(i);
  }
  if (const auto free = std::ranges::count(pin_of, kFree); free > 0) {
    compilation_notes_.push_back(baselines::note_on_free_components(static_cast<int>(free)));
  }
  if (!at_one_point_.empty()) {
    compilation_notes_.push_back(
        fmt::format("parts with handles at one point only, which may turn about it freely: {}",
                    at_one_point_.size()));
  }
  return fixed;
}

// The targets (3×#handles) are in units of unit_, those of fixed vertices first.
void PrimoDeformation::set_targets(const Eigen::Matrix3Xd& targets) {
  for (int i = 0; i < prisms_.T.cols(); ++i) {
    if (!prescribed_[i]) continue;
    Eigen::Matrix3d rest, corners;
    for (int k = 0; k < 3; ++k) {
      const int v = prisms_.T(k, i);
      rest.col(k) = V_.col(v);
      corners.col(k) = targets.col(handle_of_[v]);
    }
    fit_rigidly(rest, corners, i, motions_);
  }
  for (Pin& pin : equations_->pins()) pin.target = targets.col(pin.handle);
}

// A component that is pinned at one point may rotate about it at no cost. It is translated to its
// target, which is a minimum, so that a single handle translates the shape.
void PrimoDeformation::translate_components() {
  for (const PointPin& component : at_one_point_) {
    const Pin& pin = equations_->pins()[component.pin];
    const Eigen::Vector3d t = pin.target - motions_.apply(prisms_, pin.i, pin.p);
    for (const int i : component.prisms) motions_.c.col(i) += t;
  }
}

void PrimoDeformation::solve(const Eigen::Matrix3Xd& targets, Report& report) {
  const Eigen::Index fixed = std::ssize(handles_.fixed);
  const RigidMotions before = motions_;
  Eigen::Matrix3Xd all(3, fixed + targets.cols());
  all << V_(Eigen::all, handles_.fixed), targets / unit_;
  set_targets(all);
  translate_components();
  report.solve = minimize(*equations_, motions_, options_.epsilon, options_.max_iterations);
  if (report.solve.status == Status::kFailed) motions_ = before;
  {
    Stopwatch watch(report.seconds["transfer"]);
    if (report.solve.status != Status::kFailed) deform(targets);
  }
  report.nodes = static_cast<int>(prisms_.T.cols());
  report.edges = static_cast<int>(prisms_.joints.size());
  report.length_unit = unit_;
  measure_handles(deformed_.V(Eigen::all, handles_.moved), targets, report);
}

void PrimoDeformation::deform(const Eigen::Matrix3Xd& targets) {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, V_.cols()), normals = sum;
  Eigen::VectorXi count = Eigen::VectorXi::Zero(V_.cols());
  for (int i = 0; i < prisms_.T.cols(); ++i) {
    for (const int v : prisms_.T.col(i)) {
      if (on_prescribed_[v] && !prescribed_[i]) continue;
      sum.col(v) += motions_.apply(prisms_, i, V_.col(v));
      if (rest_.N.cols() > 0) normals.col(v) += motions_.rotation(i) * rest_.N.col(v);
      ++count[v];
    }
  }
  for (Eigen::Index v = 0; v < V_.cols(); ++v) {
    if (count[v] == 0) continue;
    deformed_.V.col(v) = unit_ / count[v] * sum.col(v);
    if (rest_.N.cols() > 0) deformed_.N.col(v) = normals.col(v).normalized();
  }
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    const int v = handles_.moved[l];
    if (count[v] == 0) deformed_.V.col(v) = targets.col(l);
  }
  for (const int v : handles_.fixed) deformed_.V.col(v) = rest_.V.col(v);  // without rounding
}

}  // namespace deformlab
