#include "experiments/benchmarks/ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "deformers/baselines/cgal_arap.h"

namespace deformlab {
namespace {

constexpr double kDrag = 0.01;       // of the side
constexpr double kArapClose = 1e-4;  // of the side
constexpr std::size_t kMostArapIterations = 200;

Eigen::Matrix3Xd targets(double side, double lift) {
  Eigen::Matrix3Xd result = reference_scene().targets;
  for (auto target : result.colwise()) target.z() += target.x() > 0.5 ? lift : 0;
  return side > 0 ? Eigen::Matrix3Xd(side * result) : result;
}

Handles with_middle_handle() {
  Handles handles = reference_scene().handles;
  handles.moved.push_back(static_cast<int>(reference_scene().shape.V.cols()) / 2);
  return handles;
}

double compile_ms(Deformer& deformation) {
  deformation.reset();
  return ms_of([&] { deformation.compile(reference_scene().handles); });
}

RunResult update_without_transfer(EmbeddedDeformation& deformation,
                                  const Eigen::Matrix3Xd& targets) {
  Report report;
  const double ms = ms_of([&] { report = deformation.update(targets); });
  return result_of(ms - 1e3 * report.seconds.at("transfer"), report.solve);
}

Way drag_of(const std::string& name, EmbeddedDeformation dragged) {
  auto deformation = std::make_shared<EmbeddedDeformation>(std::move(dragged));
  deformation->compile(reference_scene().handles);
  deformation->update(targets(0, 0));
  return {name, [deformation] {
            // The first of the two drags is not timed: it refills the caches, which the other way
            // used in between.
            deformation->update(targets(0, kDrag));
            return update_without_transfer(*deformation, targets(0, 0));
          }};
}

}  // namespace

std::string describe(const SolverOptions& o) {
  if (o.method == SolverMethod::kCeres) {
    return fmt::format("ceres {}, {}, {}, one block for each {}", o.linear_solver,
                       name_of(o.ceres_sparse_library), name_of(o.ceres_trust_region),
                       name_of(o.ceres_blocks));
  }
  return fmt::format("gauss_newton {}, {}", o.linear_solver, o.globalization);
}

SolverOptions cholmod_options() {
  SolverOptions options;
  options.linear_solver = "cholmod";
  return options;
}

SolverOptions ceres_options(const std::string& linear_solver, CeresBlocks blocks,
                            CeresTrustRegion trust_region, CeresSparseLibrary sparse_library) {
  SolverOptions options;
  options.method = SolverMethod::kCeres;
  options.linear_solver = linear_solver;
  options.ceres_blocks = blocks;
  options.ceres_trust_region = trust_region;
  options.ceres_sparse_library = sparse_library;
  return options;
}

RunResult result_of(double ms, const Summary& solve) {
  return {ms, {}, to_string(solve.status), solve.blas, solve.iterations.size(), solve.final_cost};
}

Way from_rest(int nodes, const SolverOptions& options, double side) {
  auto deformation =
      std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, options, side));
  return {describe(options), [deformation, side] {
            const double compile = compile_ms(*deformation);
            RunResult result = update_without_transfer(*deformation, targets(side, 0));
            result.ms += compile;
            return result;
          }};
}

Way with_transfer(int nodes) {
  const SolverOptions options;
  auto deformation = std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, options));
  return {describe(options) + ", and the transfer", [deformation] {
            const double compile = compile_ms(*deformation);
            Summary solve;
            const double update =
                ms_of([&] { solve = deformation->update(reference_scene().targets).solve; });
            return result_of(compile + update, solve);
          }};
}

Way drag(int nodes, const SolverOptions& options) {
  return drag_of(describe(options), reference_deformation(nodes, options));
}

Way armadillo_drag(int nodes, const SolverOptions& solver) {
  EmbeddedDeformationOptions options;
  options.solver = solver;
  options.graph.nodes = nodes;
  const ReferenceScene& scene = armadillo_scene();
  auto deformation = std::make_shared<EmbeddedDeformation>(scene.shape, options);
  deformation->compile(scene.handles);
  Eigen::Matrix3Xd away = scene.targets;
  away(1, 0) += kDrag * bounding_box_diagonal(scene.shape.V);
  deformation->update(scene.targets);
  return {describe(solver), [deformation, away, back = scene.targets] {
            deformation->update(away);  // not timed, as in drag_of
            Report report;
            const double ms = ms_of([&] { report = deformation->update(back); });
            return result_of(ms, report.solve);
          }};
}

EmbeddedDeformation preset_deformation(int nodes, Preset preset) {
  EmbeddedDeformationOptions options = preset_options(preset);
  options.graph.nodes = nodes;
  return {reference_scene().shape, options};
}

Way drag_with_preset(int nodes, Preset preset) {
  return drag_of(fmt::format("preset {}", name_of(preset)), preset_deformation(nodes, preset));
}

Way full_compilation(EmbeddedDeformation own) {
  auto deformation = std::make_shared<EmbeddedDeformation>(std::move(own));
  return {"afresh", [deformation] {
            RunResult result;
            result.ms = compile_ms(*deformation);
            return result;
          }};
}

Way change_handle(EmbeddedDeformation own) {
  auto deformation = std::make_shared<EmbeddedDeformation>(std::move(own));
  deformation->compile(reference_scene().handles);
  return {"adapted", [deformation] {
            const Handles more = with_middle_handle();
            RunResult result;
            result.ms = ms_of([&] {
                          deformation->compile(more);
                          deformation->compile(reference_scene().handles);
                        }) /
                        2;
            return result;
          }};
}

Way update_with_new_handle(EmbeddedDeformation own, bool afresh) {
  auto deformation = std::make_shared<EmbeddedDeformation>(std::move(own));
  deformation->compile(reference_scene().handles);
  deformation->update(targets(0, 0));
  return {afresh ? "afresh" : "adapted",
          [deformation, afresh, lifted = deformation->transformations()] {
            const Handles more = with_middle_handle();
            if (afresh) deformation->reset();
            deformation->compile(more);
            deformation->begin_at(lifted);
            Eigen::Matrix3Xd moved = targets(0, 0);
            moved.conservativeResize(3, moved.cols() + 1);
            moved.rightCols<1>() = deformation->deformed().V.col(more.moved.back());
            moved(2, moved.cols() - 1) += kDrag;
            RunResult result = update_without_transfer(*deformation, moved);
            deformation->begin_at(lifted);
            deformation->compile(reference_scene().handles);
            return result;
          }};
}

Way step(int nodes, const SolverOptions& options) {
  auto deformation = std::make_shared<EmbeddedDeformation>(reference_deformation(nodes, options));
  return {describe(options), [deformation] {
            const double compile = compile_ms(*deformation);
            Summary solve = deformation->update(reference_scene().targets).solve;
            const double total = 1e3 * solve.seconds["total"];
            const double steps = std::max(1.0, double(solve.iterations.size()));
            RunResult result =
                result_of((total - 1e3 * solve.seconds["preprocess"]) / steps, solve);
            result.parts = {{"whole solve", compile + total}};
            return result;
          }};
}

Way cgal_arap_from_rest() {
  CgalArapOptions options;
  options.iterations = 1;
  options.tolerance = 1e-12;
  auto deformation = std::make_shared<CgalArap>(reference_scene().shape, options);
  return {"CGAL as-rigid-as-possible, spokes and rims, until nothing moves by 1e-4 of the side",
          [deformation] {
            double ms = compile_ms(*deformation);
            Summary solve;
            std::size_t iterations = 0;
            double moved = 1;
            while (moved > kArapClose && iterations < kMostArapIterations) {
              const Eigen::Matrix3Xd before = deformation->deformed().V;
              ms += ms_of([&] { solve = deformation->update(reference_scene().targets).solve; });
              moved = (deformation->deformed().V - before).colwise().norm().maxCoeff();
              ++iterations;
            }
            RunResult result = result_of(ms, solve);
            result.steps = iterations;
            result.status =
                to_string(moved > kArapClose ? Status::kMaxIterations : Status::kConverged);
            return result;
          }};
}

}  // namespace deformlab
