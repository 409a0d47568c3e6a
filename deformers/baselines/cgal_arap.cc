#include "deformers/baselines/cgal_arap.h"

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/baselines/manifold.h"
#include "deformers/baselines/surface.h"
#include "deformers/handle_checks.h"
#include "geometry/core/disjoint_sets.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

class CgalArap::Engine {
 public:
  virtual ~Engine() = default;
  /// Returns false where the system is singular.
  virtual bool set_control_vertices(const std::vector<int>& vertices) = 0;
  virtual void set_target(int control_vertex, const Eigen::Vector3d& target) = 0;
  virtual void iterate() = 0;
  virtual void reset() = 0;
  virtual Eigen::Matrix3Xd positions() const = 0;
};

namespace {

constexpr const char* kMethod = "as-rigid-as-possible deformation";
constexpr double kNegligible = 1e-24;  // a smaller energy counts as 0 [SpokesAndRims::scale]
// Twice the least allowed area of a triangle [square of its longest side]. The cotangent weights of
// a thinner one would leave no correct digit of the solution.
constexpr double kThinnest = 1e-10;

Mesh make_mesh(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  Mesh mesh;
  for (const auto v : V.colwise()) mesh.add_vertex(Point(v.x(), v.y(), v.z()));
  for (const auto t : T.colwise()) {
    mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  }
  return mesh;
}

template <CGAL::Deformation_algorithm_tag variant>
class EngineOf final : public CgalArap::Engine {
 public:
  EngineOf(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T)
      : mesh_(make_mesh(V, T)), deformation_(mesh_) {
    deformation_.insert_roi_vertices(mesh_.vertices().begin(), mesh_.vertices().end());
  }
  bool set_control_vertices(const std::vector<int>& vertices) override {
    deformation_.clear_control_vertices();
    for (const int v : vertices) deformation_.insert_control_vertex(Mesh::Vertex_index(v));
    return deformation_.preprocess();
  }
  void set_target(int control_vertex, const Eigen::Vector3d& p) override {
    deformation_.set_target_position(Mesh::Vertex_index(control_vertex),
                                     Point(p.x(), p.y(), p.z()));
  }
  void iterate() override { deformation_.deform(1, 0); }
  void reset() override { deformation_.reset(); }
  Eigen::Matrix3Xd positions() const override {
    Eigen::Matrix3Xd V(3, mesh_.number_of_vertices());
    for (const auto v : mesh_.vertices()) {
      const Point& p = mesh_.point(v);
      V.col(v) << p.x(), p.y(), p.z();
    }
    return V;
  }

 private:
  Mesh mesh_;
  CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, variant> deformation_;
};

std::unique_ptr<CgalArap::Engine> make_engine(CgalArapVariant variant, const Eigen::Matrix3Xd& V,
                                              const Eigen::Matrix3Xi& T) {
  switch (variant) {
    case CgalArapVariant::kOriginal:
      return std::make_unique<EngineOf<CGAL::ORIGINAL_ARAP>>(V, T);
    case CgalArapVariant::kSmoothRotations:
      return std::make_unique<EngineOf<CGAL::SRE_ARAP>>(V, T);
    case CgalArapVariant::kSpokesAndRims:
      break;
  }
  return std::make_unique<EngineOf<CGAL::SPOKES_AND_RIMS>>(V, T);
}

void reject_thin(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  for (const Eigen::Vector3i t : T.colwise()) {
    if (!baselines::is_thin(V(Eigen::all, t), kThinnest)) continue;
    throw InputError(fmt::format(
        "the triangle of vertices {}, {} and {} has no area, and {} weighs edges by cotangents; "
        "repair the mesh, or use embedded deformation",
        t[0], t[1], t[2], kMethod));
  }
}

}  // namespace

CgalArap::CgalArap(Shape rest, const CgalArapOptions& options)
    : Baseline(std::move(rest)), options_(options) {
  check_options(options_);
  {
    Stopwatch watch(seconds_["register"]);
    register_shape();
  }
  compile({});
}

void CgalArap::register_shape() {
  auto [T, vertices, notes] = baselines::surface_of(rest_, kMethod);
  reject_thin(rest_.V, T);
  const std::string fault = manifold_fault(T, static_cast<int>(rest_.V.cols()));
  if (!fault.empty()) {
    throw InputError(fmt::format(
        "the shape is no manifold mesh: {}; mend it, or use embedded deformation, which takes any "
        "shape",
        fault));
  }
  vertices_ = std::move(vertices);
  registration_notes_ = std::move(notes);
  index_.assign(rest_.V.cols(), -1);
  for (int i = 0; i < std::ssize(vertices_); ++i) index_[vertices_[i]] = i;
  V_ = rest_.V(Eigen::all, vertices_);
  T_ = T.unaryExpr([&](int v) { return index_[v]; });
  engine_ = make_engine(options_.variant, V_, T_);
}

CgalArap::~CgalArap() = default;

void CgalArap::reset() {
  engine_->reset();
  deformed_ = rest_;
}

void CgalArap::check_supported(const Handles& handles) const {
  baselines::refuse_points(handles, kMethod);
}

void CgalArap::compile_handles() {
  const std::vector<int> control = control_vertices();
  unknowns_ = static_cast<int>(3 * (V_.cols() - std::ssize(control)));
  solvable_ = engine_->set_control_vertices(control);
}

// The handles and all vertices of components without a handle, which could move at no cost.
std::vector<int> CgalArap::control_vertices() {
  DisjointSets sets(V_.cols());
  sets.join_corners(T_);
  const std::vector<int> component = sets.numbered();
  std::vector<char> is_handle(V_.cols(), 0), has_handle(1 + std::ranges::max(component), 0);
  for (const auto* vertices : {&handles_.fixed, &handles_.moved}) {
    for (const int v : *vertices) {
      const int i = index_[v];
      if (i >= 0) is_handle[i] = has_handle[component[i]] = 1;
    }
  }
  std::vector<int> result;
  for (int i = 0; i < V_.cols(); ++i) {
    if (is_handle[i] || !has_handle[component[i]]) result.push_back(i);
  }
  if (const auto free = std::ranges::count(has_handle, 0); free > 0) {
    compilation_notes_.push_back(baselines::note_on_free_components(static_cast<int>(free)));
  }
  return result;
}

void CgalArap::set_targets(const Eigen::Matrix3Xd& targets) {
  for (const int v : handles_.fixed) {
    if (index_[v] >= 0) engine_->set_target(index_[v], rest_.V.col(v));
  }
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    const int v = handles_.moved[l];
    if (index_[v] >= 0) engine_->set_target(index_[v], targets.col(l));
  }
}

std::pair<Status, std::string> CgalArap::iterate(Summary& summary, SpokesAndRims& state) {
  for (int k = 0; k < options_.iterations; ++k) {
    Iteration iteration;
    Stopwatch watch(iteration.seconds);
    {
      Stopwatch solve_watch(summary.seconds["solve"]);
      engine_->iterate();
    }
    const Eigen::Matrix3Xd W = engine_->positions();
    {
      Stopwatch evaluate_watch(summary.seconds["evaluate"]);
      state = spokes_and_rims(V_, W, T_);
    }
    iteration.cost = state.energy;
    iteration.step_max = (W - W_).cwiseAbs().maxCoeff();
    iteration.seconds = watch.elapsed();
    W_ = W;
    const double last = k > 0 ? summary.iterations.back().cost : INFINITY;
    summary.iterations.push_back(iteration);
    if (!std::isfinite(state.energy)) return {Status::kFailed, "the energy is not finite"};
    const double change = std::abs(state.energy - last);
    if (state.energy <= kNegligible * state.scale) return {Status::kConverged, "no energy is left"};
    if (change < options_.tolerance * state.energy) {
      return {Status::kConverged, "an iteration changes the energy by less than the tolerance"};
    }
  }
  return {Status::kMaxIterations, "the energy still changes after the iterations allowed"};
}

void CgalArap::solve(const Eigen::Matrix3Xd& targets, Report& report) {
  Summary& summary = report.solve;
  summary.method = "cgal_arap";
  summary.linear_solver = "eigen_sparse_lu";
  summary.unknowns = unknowns_;
  if (!solvable_) {
    summary.message =
        "CGAL cannot factorize the Laplacian; look for very thin triangles, and repair them";
  } else if (targets.size() > 0 && targets.cwiseAbs().maxCoeff() > kMostLength) {
    summary.message = "a target is too far away to compute with";
  } else {
    SpokesAndRims state;
    set_targets(targets);
    W_ = engine_->positions();
    {
      Stopwatch watch(summary.seconds["total"]);
      std::tie(summary.status, summary.message) = iterate(summary, state);
    }
    summary.initial_cost = summary.iterations.front().cost;
    summary.final_cost = state.energy;
    Stopwatch watch(report.seconds["transfer"]);
    if (summary.status == Status::kFailed) {
      engine_->reset();
    } else {
      store(targets, state.R);
    }
  }
  measure_handles(deformed_.V(Eigen::all, handles_.moved), targets, report);
}

void CgalArap::store(const Eigen::Matrix3Xd& targets, const Eigen::Matrix3Xd& R) {
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    deformed_.V.col(handles_.moved[l]) = targets.col(l);
  }
  for (int i = 0; i < std::ssize(vertices_); ++i) {
    const int v = vertices_[i];
    deformed_.V.col(v) = W_.col(i);
    if (rest_.N.cols() > 0)
      deformed_.N.col(v) = (R.middleCols<3>(3 * i) * rest_.N.col(v)).normalized();
  }
  for (const int v : handles_.fixed) deformed_.V.col(v) = rest_.V.col(v);
}

}  // namespace deformlab
