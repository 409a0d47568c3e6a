#include "experiments/measure/drag.h"

#include <algorithm>

#include "geometry/core/median.h"
#include "solvers/stopwatch.h"

namespace deformlab {
Eigen::Matrix3Xd targets_at_rest(const Shape& rest, const Handles& handles) {
  Eigen::Matrix3Xd targets(3, handles.targets());
  targets << rest.V(Eigen::all, handles.moved), handles.points;
  return targets;
}

DragReport drag(Deformer& deformer, const Shape& rest, const ResolvedEdit& edit,
                const DragOptions& options, const std::function<void()>& after) {
  const Eigen::Matrix3Xd from = targets_at_rest(rest, edit.handles);
  const int updates = options.back ? 2 * options.steps : options.steps;
  DragReport result;
  double most = 0, sum = 0;
  std::map<std::string, std::vector<double>> seconds;  // of each update
  bool finite = true;
  Handles handles = edit.handles;
  for (int i = 1; i <= updates; ++i) {
    const int steps_away = i <= options.steps ? i : updates - i;
    const double share = static_cast<double>(steps_away) / options.steps;
    if (updates > 1 && handles.rotations.cols() > 0) {
      handles.rotations = share * edit.handles.rotations;
      deformer.compile(handles);
    }
    {
      Stopwatch watch(seconds["seconds.update"].emplace_back());
      result.last = deformer.update(edit.targets_at(share, from));
    }
    const auto steps = static_cast<double>(result.last.solve.iterations.size());
    for (const auto& [phase, its] : result.last.solve.seconds) {
      seconds["seconds.update." + phase].push_back(its);
    }
    most = std::max(most, steps);
    sum += steps;
    after();
    finite = finite && deformer.deformed().V.allFinite();
  }
  result.metrics = {{"iterations_max", most}, {"iterations_mean", sum / updates}};
  result.metrics["finite"] = finite;
  for (auto& [phase, of_each] : seconds) result.seconds[phase] = median(of_each);
  return result;
}

}  // namespace deformlab
