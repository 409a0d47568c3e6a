#include "deformers/baselines/primo_deformation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/baselines/prism_solver.h"
#include "deformers/baselines/shared.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSamePlace = 1e-6;  // [mean side]

}  // namespace

PrimoDeformation::PrimoDeformation(Shape rest, const PrimoOptions& options)
    : options_(options), rest_(std::move(rest)), deformed_(rest_) {
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

void PrimoDeformation::compile(const Handles& handles) {
  check_handles(handles, rest_.V.cols());
  baselines::refuse_points(handles, "PriMo");
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  handles_ = handles;
  compilation_notes_.clear();
  choose_prescribed();
  std::vector<Pin> pins = make_pins();
  const std::vector<char> held = hold_free_parts(pins);
  equations_ = std::make_unique<PrismEquations>(prisms_, std::move(pins), held);
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
    if (is_thin(V_(Eigen::all, corners))) continue;
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

// Marks the prescribed prisms, and those of parts without a handle: they would float at no cost.
std::vector<char> PrimoDeformation::hold_free_parts(const std::vector<Pin>& pins) {
  std::vector<std::pair<int, int>> links;
  for (const Joint& joint : prisms_.joints) links.emplace_back(joint.i, joint.j);
  const int m = static_cast<int>(prisms_.T.cols());
  const std::vector<int> part = baselines::components(m, links);
  const int parts = *std::max_element(part.begin(), part.end()) + 1;

  constexpr int kFree = -1, kAnchored = -2;  // else a pin, all of the part being where it is
  std::vector<int> hold(parts, kFree);
  for (int k = 0; k < std::ssize(pins); ++k) {
    int& by = hold[part[pins[k].i]];
    if (by == kFree) by = k;
    if (by >= 0 && (pins[by].p - pins[k].p).norm() > kSamePlace) by = kAnchored;
  }
  for (int i = 0; i < m; ++i) {
    if (prescribed_[i]) hold[part[i]] = kAnchored;
  }
  std::vector<char> held = prescribed_;
  at_one_point_.clear();
  std::vector<int> index(parts, -1);
  for (int i = 0; i < m; ++i) {
    const int p = part[i];
    if (hold[p] == kFree) held[i] = 1;
    if (hold[p] < 0) continue;
    if (index[p] < 0) {
      index[p] = static_cast<int>(at_one_point_.size());
      at_one_point_.push_back({{}, hold[p]});
    }
    at_one_point_[index[p]].prisms.push_back(i);
  }
  if (const auto free = std::count(hold.begin(), hold.end(), kFree); free > 0) {
    compilation_notes_.push_back(
        "parts of the surface without a handle, which stay where they are: " +
        std::to_string(free));
  }
  if (!at_one_point_.empty()) {
    compilation_notes_.push_back("parts held at one point only, which may turn about it freely: " +
                                 std::to_string(at_one_point_.size()));
  }
  return held;
}

// targets: 3×#handles, the fixed ones first [unit].
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

// A part held at one point may turn about it at no cost. It starts where its handle takes it
// without turning, which is then a minimum: one handle is a translation.
void PrimoDeformation::carry_along() {
  for (const PointPin& part : at_one_point_) {
    const Pin& pin = equations_->pins()[part.pin];
    const Eigen::Vector3d t = pin.target - motions_.apply(prisms_, pin.i, pin.p);
    for (const int i : part.prisms) motions_.c.col(i) += t;
  }
}

Report PrimoDeformation::update(const Eigen::Matrix3Xd& targets) {
  const Eigen::Index fixed = std::ssize(handles_.fixed);
  check_targets(targets, std::ssize(handles_.moved));
  Report report;
  const RigidMotions before = motions_;
  Eigen::Matrix3Xd all(3, fixed + targets.cols());
  all << V_(Eigen::all, handles_.fixed), targets / unit_;
  set_targets(all);
  carry_along();
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
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = report.solve.seconds["total"];
  report.notes = registration_notes_;
  report.notes.insert(report.notes.end(), compilation_notes_.begin(), compilation_notes_.end());
  return report;
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
  for (const int v : handles_.fixed) deformed_.V.col(v) = rest_.V.col(v);  // free of rounding
}

}  // namespace deformlab
