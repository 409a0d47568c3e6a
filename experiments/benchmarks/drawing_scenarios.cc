// A drawing is compared with CGAL's Surface_mesh_deformation (spokes and rims, Eigen's SparseLU) on
// the same mesh with the same handles.
#define CGAL_EIGEN3_ENABLED
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "deformers/arap_2d/closed_form_steps.h"
#include "deformers/arap_2d/registered_mesh.h"
#include "experiments/benchmarks/scenarios.h"
#include "geometry/plane/triangulation.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kLeastSeconds = 0.02;  // a shorter action is repeated until this time is over

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Arap = CGAL::Surface_mesh_deformation<Mesh>;

struct Drawing {
  Triangulation mesh;
  std::array<int, 4> handles{};  // vertices, of which the last is the one that is added
  Eigen::Matrix2Xd targets;      // 2×3
};

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

// The handles are the vertices nearest to the ends of the arms; the first is moved.
Drawing drawing(int vertices) {
  Drawing result{five_arms(vertices), {}, Eigen::Matrix2Xd(2, 3)};
  for (int arm = 0; arm < 4; ++arm) {
    const double angle = 2 * std::numbers::pi * (2 * arm % 5) / 5;
    const Eigen::Vector2d end(130 * std::cos(angle), 130 * std::sin(angle));
    (result.mesh.V.colwise() - end).colwise().squaredNorm().minCoeff(&result.handles[arm]);
    if (arm < 3) result.targets.col(arm) = result.mesh.V.col(result.handles[arm]);
  }
  result.targets.col(0) += Eigen::Vector2d(20, 35);
  return result;
}

// The mean time of one call [ms], over as many calls as take long enough to be measured. What is
// done before each call is not counted.
template <class Call, class Before>
double mean_ms(Call&& call, Before&& before) {
  double seconds = 0;
  int calls = 0;
  while (seconds < kLeastSeconds) {
    before();
    Stopwatch watch(seconds);
    call();
    ++calls;
  }
  return 1e3 * seconds / calls;
}

template <class Call>
double mean_ms(Call&& call) {
  return mean_ms(call, [] {});
}

RunResult result_of(double ms) {
  RunResult result;
  result.ms = ms;
  return result;
}

class TwoStepWay {
 public:
  explicit TwoStepWay(int vertices)
      : drawing_(drawing(vertices)),
        weights_(Eigen::VectorXd::Ones(drawing_.mesh.F.cols())),
        deformation_(drawing_.mesh, weights_),
        registered_(drawing_.mesh, weights_),
        z_(registered_.p) {
    for (const int v : drawing_.handles) more_.push_back(BarycentricPoint::at_vertex(v));
    handles_.assign(more_.begin(), more_.end() - 1);
    deformation_.compile(handles_);
  }

  RunResult registration() {
    return result_of(mean_ms([&] { ClosedFormSteps(drawing_.mesh, weights_); }));
  }

  // After a reset, all handles are compiled.
  RunResult compile() {
    return result_of(
        mean_ms([&] { deformation_.compile(handles_); }, [&] { deformation_.reset(); }));
  }

  RunResult add() {
    return result_of(
        mean_ms([&] { deformation_.compile(more_); }, [&] { deformation_.compile(handles_); }));
  }

  RunResult change() {
    return result_of(mean_ms([&] {
                       deformation_.compile(more_);
                       deformation_.compile(handles_);
                     }) /
                     2);
  }

  RunResult update() {
    TwoStepSolver::Seconds phases;
    double calls = 0;
    RunResult result;
    result.ms = mean_ms([&] {
      deformation_.update(drawing_.targets);
      phases.step_one += deformation_.seconds().step_one;
      phases.fit += deformation_.seconds().fit;
      phases.step_two += deformation_.seconds().step_two;
      ++calls;
    });
    const double solve = mean_ms([&] { registered_.H_grounded.solve(z_); });
    result.parts = {{"step one", 1e3 * phases.step_one / calls},
                    {"fit", 1e3 * phases.fit / calls},
                    {"step two", 1e3 * phases.step_two / calls},
                    {"bare triangular solve of step two", solve}};
    return result;
  }

 private:
  Drawing drawing_;
  Eigen::VectorXd weights_;
  std::vector<BarycentricPoint> handles_, more_;  // three and four
  ClosedFormSteps deformation_;
  RegisteredMesh registered_;
  Eigen::VectorXcd z_;
};

class CgalWay {
 public:
  explicit CgalWay(int vertices)
      : drawing_(drawing(vertices)), mesh_(to_cgal(drawing_.mesh)), deformation_(mesh_) {
    deformation_.insert_roi_vertices(mesh_.vertices().begin(), mesh_.vertices().end());
    preprocess(3);
  }

  RunResult compile() {
    return result_of(mean_ms([&] { preprocess(3); }));
  }

  RunResult add() {
    return result_of(mean_ms([&] { preprocess(4); }));
  }

  RunResult update() {
    for (int i = 0; i < 3; ++i) {
      deformation_.set_target_position(Mesh::Vertex_index(drawing_.handles[i]),
                                       Point(drawing_.targets(0, i), drawing_.targets(1, i), 0));
    }
    RunResult result;
    result.ms = mean_ms([&] { deformation_.deform(1, 0); });
    return result;
  }

 private:
  static Mesh to_cgal(const Triangulation& mesh) {
    Mesh result;
    for (const auto v : mesh.V.colwise()) result.add_vertex(Point(v.x(), v.y(), 0));
    for (const auto f : mesh.F.colwise()) {
      result.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
    }
    return result;
  }

  // CGAL factorizes again after a change of the handles.
  void preprocess(int handles) {
    deformation_.clear_control_vertices();
    for (int i = 0; i < handles; ++i) {
      deformation_.insert_control_vertex(Mesh::Vertex_index(drawing_.handles[i]));
    }
    deformation_.preprocess();
  }

  Drawing drawing_;
  Mesh mesh_;
  Arap deformation_;
};

// A way that measures one action of a kind of deformation, which it makes once.
template <class Kind>
Way way(const char* name, int vertices, RunResult (Kind::*action)()) {
  auto kept = std::make_shared<Kind>(vertices);
  return {name, [kept, action] { return (*kept.*action)(); }};
}

Way two_steps(const char* name, int vertices, RunResult (TwoStepWay::*action)()) {
  return way(name, vertices, action);
}

Way cgal_preprocessing(int vertices, RunResult (CgalWay::*action)() = &CgalWay::compile) {
  return way("CGAL, a preprocessing, spokes and rims, SparseLU", vertices, action);
}

}  // namespace

std::vector<Scenario> drawing_scenarios() {
  const std::vector<int> sizes = {93, 150, 300, 1000, 5000, 20000};
  return {
      {"an update of a drawing", "an iteration of CGAL", "vertices", sizes,
       [](int n) { return two_steps("arap_2d, an update", n, &TwoStepWay::update); },
       [](int n) {
         return way("CGAL, an iteration, spokes and rims, SparseLU", n, &CgalWay::update);
       }},
      {"a registration of a drawing", "CGAL's preprocessing", "vertices", sizes,
       [](int n) { return two_steps("arap_2d, a registration", n, &TwoStepWay::registration); },
       [](int n) { return cgal_preprocessing(n); }},
      {"a compilation of a drawing", "CGAL's preprocessing", "vertices", sizes,
       [](int n) { return two_steps("arap_2d, a compilation", n, &TwoStepWay::compile); },
       [](int n) { return cgal_preprocessing(n); }},
      {"one handle added to a drawing",
       "CGAL's preprocessing",
       "vertices",
       {1000, 20000},
       [](int n) { return two_steps("arap_2d, a fourth handle", n, &TwoStepWay::add); },
       [](int n) { return cgal_preprocessing(n, &CgalWay::add); }},
      {"a handle of a drawing added or removed", "a full compilation", "vertices", sizes,
       [](int n) { return two_steps("arap_2d, adapted", n, &TwoStepWay::change); },
       [](int n) { return two_steps("arap_2d, afresh", n, &TwoStepWay::compile); }},
  };
}

}  // namespace deformlab
