#include "experiments/benchmarks/rigid_comparison.h"

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "deformers/arap_2d/registered_mesh.h"
#include "deformers/arap_2d/closed_form_steps.h"
#include "geometry/plane/triangulation.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kLeastSeconds = 0.02;  // of a measurement: short updates are repeated

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Arap = CGAL::Surface_mesh_deformation<Mesh>;

Triangulation five_arms(int vertices) {
  constexpr int kCorners = 400;
  Region region;
  region.outline.resize(2, kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const double r = 100 * (1 + 0.45 * std::cos(5 * angle));
    region.outline.col(i) << r * std::cos(angle), r * std::sin(angle);
  }
  return triangulate(region, {.vertices = vertices}, "five arms");
}

// The vertices nearest to the ends of three arms.
std::array<int, 3> three_ends(const Triangulation& mesh) {
  std::array<int, 3> result{};
  for (int arm = 0; arm < 3; ++arm) {
    const double angle = 2 * std::numbers::pi * (2 * arm % 5) / 5;
    const Eigen::Vector2d end(130 * std::cos(angle), 130 * std::sin(angle));
    (mesh.V.colwise() - end).colwise().squaredNorm().minCoeff(&result[arm]);
  }
  return result;
}

Mesh to_cgal(const Triangulation& mesh) {
  Mesh result;
  for (const auto v : mesh.V.colwise()) result.add_vertex(Point(v.x(), v.y(), 0));
  for (const auto f : mesh.F.colwise()) {
    result.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
  }
  return result;
}

// Seconds of one call, over as many as take long enough to be measured.
template <class Call>
double seconds_of(Call&& call) {
  double seconds = 0;
  int calls = 0;
  while (seconds < kLeastSeconds) {
    Stopwatch watch(seconds);
    call();
    ++calls;
  }
  return seconds / calls;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// What is measured, repetition by repetition [ms].
struct Samples {
  std::vector<double> compile, preprocess, step_one, fit, step_two, update, solve, iteration;
};

double median_ratio(const std::vector<double>& theirs, const std::vector<double>& ours) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(theirs[i] / ours[i]);
  return median(ratios);
}

class Pair {
 public:
  explicit Pair(const Triangulation& mesh)
      : ends_(three_ends(mesh)),
        weights_(Eigen::VectorXd::Ones(mesh.F.cols())),
        ours_(mesh, weights_),
        registered_(mesh, weights_),
        z_(registered_.p),
        cgal_mesh_(to_cgal(mesh)),
        theirs_(cgal_mesh_) {
    for (int i = 0; i < 3; ++i) {
      places_.push_back(BarycentricPoint::at_vertex(ends_[i]));
      targets_.col(i) = mesh.V.col(ends_[i]);
    }
    targets_.col(0) += Eigen::Vector2d(20, 35);
    theirs_.insert_roi_vertices(cgal_mesh_.vertices().begin(), cgal_mesh_.vertices().end());
  }

  void measure(Samples& s) {
    const auto keep = [](std::vector<double>& to, double seconds) { to.push_back(1e3 * seconds); };
    keep(s.compile, seconds_of([&] { ours_.compile(places_); }));
    keep(s.preprocess, seconds_of([&] { preprocess(); }));
    TwoStepSolver::Seconds phases;
    int calls = 0;
    keep(s.update, seconds_of([&] {
           ours_.update(targets_);
           phases.step_one += ours_.seconds().step_one;
           phases.fit += ours_.seconds().fit;
           phases.step_two += ours_.seconds().step_two;
           ++calls;
         }));
    for (int i = 0; i < 3; ++i) {
      theirs_.set_target_position(Mesh::Vertex_index(ends_[i]),
                                  Point(targets_(0, i), targets_(1, i), 0));
    }
    keep(s.iteration, seconds_of([&] { theirs_.deform(1, 0); }));
    keep(s.solve, seconds_of([&] { registered_.H_grounded.solve(z_); }));
    keep(s.step_one, phases.step_one / calls);
    keep(s.fit, phases.fit / calls);
    keep(s.step_two, phases.step_two / calls);
  }

 private:
  // A change of handles makes CGAL factorize again.
  void preprocess() {
    theirs_.clear_control_vertices();
    for (const int v : ends_) theirs_.insert_control_vertex(Mesh::Vertex_index(v));
    theirs_.preprocess();
  }

  std::array<int, 3> ends_;
  std::vector<BarycentricPoint> places_;
  Eigen::Matrix2Xd targets_ = Eigen::Matrix2Xd(2, 3);
  Eigen::VectorXd weights_;
  ClosedFormSteps ours_;
  RegisteredMesh registered_;
  Eigen::VectorXcd z_;
  Mesh cgal_mesh_;
  Arap theirs_;
};

std::string row(const RigidComparison& c) {
  char text[256];
  std::snprintf(text, sizeof text,
                "| %d | %.2f | %.3f | %.3f | %.1f× | %.5f | %.5f | %.5f | %.5f | %.5f | %.4f | "
                "**%.1f×** |\n",
                c.vertices, c.registration, c.compile, c.cgal_preprocess, c.compile_ratio,
                c.step_one, c.fit, c.step_two, c.update, c.bare_solve, c.cgal_iteration,
                c.update_ratio);
  return text;
}

}  // namespace

RigidComparison compare_rigid(int vertices, int repetitions) {
  const Triangulation mesh = five_arms(vertices);
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(mesh.F.cols());
  RigidComparison result;
  result.vertices = static_cast<int>(mesh.V.cols());
  result.registration = 1e3 * seconds_of([&] { ClosedFormSteps(mesh, weights); });
  Pair pair(mesh);
  Samples s;
  for (int i = 0; i < repetitions; ++i) pair.measure(s);
  result.compile = median(s.compile);
  result.cgal_preprocess = median(s.preprocess);
  result.compile_ratio = median_ratio(s.preprocess, s.compile);
  result.step_one = median(s.step_one);
  result.fit = median(s.fit);
  result.step_two = median(s.step_two);
  result.update = median(s.update);
  result.bare_solve = median(s.solve);
  result.cgal_iteration = median(s.iteration);
  result.update_ratio = median_ratio(s.iteration, s.update);
  return result;
}

std::string to_markdown(const std::vector<RigidComparison>& comparisons) {
  std::string text =
      "| vertices | registration | compilation | CGAL preprocess | ratio | step one | fit | step "
      "two | update | bare triangular solve | CGAL iteration | ratio |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  bool holds = true;
  for (const RigidComparison& c : comparisons) {
    text += row(c);
    holds = holds && c.holds();
  }
  char verdict[256];
  std::snprintf(
      verdict, sizeof verdict,
      "\nMilliseconds, medians, in turns. Expected: an update at least %g times as fast as "
      "an iteration, a compilation %g times as fast as a preprocess: %s\n",
      kUpdateRatio, kCompileRatio, holds ? "ok" : "falls short");
  return text + verdict;
}

}  // namespace deformlab
