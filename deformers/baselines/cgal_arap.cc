#include "deformers/baselines/cgal_arap.h"

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "deformers/baselines/manifold.h"
#include "deformers/baselines/shared.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

class CgalArap::Engine {
 public:
  virtual ~Engine() = default;
  /// False where the system is singular.
  virtual bool hold(const std::vector<int>& vertices) = 0;
  virtual void set_targets(int vertex, const Eigen::Vector3d& target) = 0;
  virtual void iterate() = 0;
  virtual void reset() = 0;
  virtual Eigen::Matrix3Xd positions() const = 0;
};

namespace {

constexpr double kNegligible = 1e-24;  // energy, as a share of what deforming all would cost
constexpr double kThinnest = 1e-10;    // twice the area of a triangle in its longest side squared

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
  bool hold(const std::vector<int>& vertices) override {
    deformation_.clear_control_vertices();
    for (const int v : vertices) deformation_.insert_control_vertex(Mesh::Vertex_index(v));
    return deformation_.preprocess();
  }
  void set_targets(int vertex, const Eigen::Vector3d& p) override {
    deformation_.set_target_position(Mesh::Vertex_index(vertex), Point(p.x(), p.y(), p.z()));
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

// Their cotangents would outweigh all others, and leave no digit of the solution.
void reject_thin(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  for (const auto t : T.colwise()) {
    const Eigen::Vector3d a = V.col(t[1]) - V.col(t[0]), b = V.col(t[2]) - V.col(t[0]);
    const double longest2 = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    if (a.cross(b).norm() > kThinnest * longest2) continue;
    throw InputError("the triangle of vertices " + std::to_string(t[0]) + ", " +
                     std::to_string(t[1]) + " and " + std::to_string(t[2]) +
                     " has no area, and as-rigid-as-possible deformation weighs edges by "
                     "cotangents; repair the mesh, or use embedded deformation");
  }
}

}  // namespace

CgalArap::CgalArap(Shape rest, const CgalArapOptions& options)
    : options_(options), rest_(std::move(rest)), deformed_(rest_) {
  check_options(options_);
  {
    Stopwatch watch(seconds_["register"]);
    register_shape();
  }
  compile({});
}

void CgalArap::register_shape() {
  auto [T, vertices, notes] = baselines::surface_of(rest_, "as-rigid-as-possible deformation");
  reject_thin(rest_.V, T);
  const std::string fault = manifold_fault(T, static_cast<int>(rest_.V.cols()));
  if (!fault.empty()) {
    throw InputError("the shape is no manifold mesh: " + fault +
                     "; mend it, or use embedded deformation, which takes any shape");
  }
  vertices_ = std::move(vertices);
  registration_notes_ = std::move(notes);
  place_.assign(rest_.V.cols(), -1);
  for (int i = 0; i < std::ssize(vertices_); ++i) place_[vertices_[i]] = i;
  V_ = rest_.V(Eigen::all, vertices_);
  T_ = T.unaryExpr([&](int v) { return place_[v]; });
  engine_ = make_engine(options_.variant, V_, T_);
}

CgalArap::~CgalArap() = default;

void CgalArap::reset() {
  engine_->reset();
  deformed_ = rest_;
}

void CgalArap::compile(const Handles& handles) {
  check_handles(handles, rest_.V.cols());
  baselines::refuse_points(handles, "as-rigid-as-possible deformation");
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  handles_ = handles;
  compilation_notes_.clear();
  const std::vector<int> held = hold_free_parts();
  unknowns_ = static_cast<int>(3 * (V_.cols() - std::ssize(held)));
  solvable_ = engine_->hold(held);
}

// The handles' places, and those of parts without a handle, which would float at no cost.
std::vector<int> CgalArap::hold_free_parts() {
  std::vector<std::pair<int, int>> links;
  for (const auto t : T_.colwise()) {
    links.emplace_back(t[0], t[1]);
    links.emplace_back(t[0], t[2]);
  }
  const std::vector<int> part = baselines::components(static_cast<int>(V_.cols()), links);
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  std::vector<char> held(V_.cols(), 0), part_held(parts, 0);
  for (const auto* indices : {&handles_.fixed, &handles_.moved}) {
    for (const int v : *indices) {
      if (place_[v] >= 0) held[place_[v]] = part_held[part[place_[v]]] = 1;
    }
  }
  std::vector<int> result;
  for (int v = 0; v < V_.cols(); ++v) {
    if (held[v] || !part_held[part[v]]) result.push_back(v);
  }
  if (const auto free = std::count(part_held.begin(), part_held.end(), 0); free > 0) {
    compilation_notes_.push_back(
        "parts of the surface without a handle, which stay where they are: " +
        std::to_string(free));
  }
  return result;
}

void CgalArap::set_targets(const Eigen::Matrix3Xd& targets) {
  for (const int v : handles_.fixed) {
    if (place_[v] >= 0) engine_->set_targets(place_[v], rest_.V.col(v));
  }
  for (Eigen::Index l = 0; l < targets.cols(); ++l) {
    const int v = handles_.moved[l];
    if (place_[v] >= 0) engine_->set_targets(place_[v], targets.col(l));
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

Report CgalArap::update(const Eigen::Matrix3Xd& targets) {
  check_targets(targets, std::ssize(handles_.moved));
  Report report;
  Summary& summary = report.solve;
  summary.method = "cgal_arap";
  summary.linear_solver = "eigen_sparse_lu";
  summary.unknowns = unknowns_;
  if (!solvable_) {
    summary.message = "CGAL cannot factorize the Laplacian: are there triangles without area?";
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
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.seconds["solve"] = summary.seconds["total"];
  report.notes = registration_notes_;
  report.notes.insert(report.notes.end(), compilation_notes_.begin(), compilation_notes_.end());
  return report;
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
