#include "experiments/subjects/motion/performance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/config/csv.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr double kBeyond = 0.5;  // how far poses are extrapolated, in sizes of the canvas

CsvTable table_of(const ConfigNode& file, const std::string& key,
                  const std::vector<std::string>& columns) {
  if (file.kind != ConfigNode::Kind::kScalar) {
    throw InputError(fmt::format("'{}' ({}): expected the name of a CSV file", key, file.where()));
  }
  return {file.folder() / file.text, columns};
}

void check_after(const CsvTable& table, std::size_t row, bool may_be_equal) {
  if (row == 0) return;
  const double before = table.number(row - 1, "time"), here = table.number(row, "time");
  if (here > before || (may_be_equal && here == before)) return;
  throw InputError(
      fmt::format("{}: time is {:g}, but {:g} in the row before; rows stand in the "
                  "order of time",
                  table.where(row), here, before));
}

std::map<std::string, Eigen::Vector2d> places_of(const std::vector<NamedHandleOptions>& handles) {
  std::map<std::string, Eigen::Vector2d> places;
  for (const NamedHandleOptions& handle : handles) {
    const std::string what = fmt::format("handles: {}", quote(handle.name));
    const Eigen::Vector2d place = point_of(handle.at, what);
    for (const auto& [name, other] : places) {
      if (name != handle.name && other != place) continue;
      throw InputError(fmt::format("{} and {} have the same {}; keep one of them", what,
                                   quote(name), name == handle.name ? "name" : "place"));
    }
    places.emplace(handle.name, place);
  }
  return places;
}

std::vector<std::string> names_in(const std::map<std::string, Eigen::Vector2d>& places) {
  std::vector<std::string> names;
  for (const auto& [name, place] : places) names.push_back(name);
  return names;
}

Eigen::AlignedBox2d grown(const Eigen::AlignedBox2d& box, double share) {
  return {box.min() - share * box.sizes(), box.max() + share * box.sizes()};
}

}  // namespace

Eigen::Vector2d point_of(const std::vector<double>& at, const std::string& what) {
  if (at.size() == 2) return {at[0], at[1]};
  throw InputError(
      fmt::format("{}: 'at' has {} numbers; expected a point [x, y]", what, at.size()));
}

CursorPath read_cursor(const ConfigNode& file, double fps) {
  const CsvTable table = table_of(file, "cursor", {"time", "x", "y"});
  if (table.rows() < 2) {
    throw InputError(fmt::format("'{}' has {} rows; a cursor that moves needs two or more",
                                 file.text, table.rows()));
  }
  CursorPath path;
  path.at.resize(2, static_cast<Eigen::Index>(table.rows()));
  for (std::size_t i = 0; i < table.rows(); ++i) {
    check_after(table, i, false);
    path.moments.push_back(static_cast<FrameTime>(table.number(i, "time")) * fps);
    // Before the assignment, because a list that an exception leaves unfinished is an error of
    // Eigen.
    const Eigen::Vector2d at(table.number(i, "x"), table.number(i, "y"));
    path.at.col(static_cast<Eigen::Index>(i)) = at;
    path.where.push_back(table.where(i));
  }
  return path;
}

PerformedPoses::PerformedPoses(const SpatialScript& script, const Eigen::AlignedBox2d& page)
    : points_(script.points), cursor_(script.cursor), keys_(script.points) {
  Eigen::AlignedBox2d canvas = page;
  for (const auto& point : script.points.colwise()) canvas.extend(Eigen::Vector2d(point));
  const Eigen::AlignedBox2d limit = grown(canvas, kBeyond);
  bool held = false;
  std::string note;
  for (Eigen::Index i = 0; i < cursor_.at.cols(); ++i) {
    const Eigen::Vector2d at = cursor_.at.col(i);
    if (canvas.contains(at)) continue;
    if (note.empty()) {
      note = fmt::format(
          "the cursor leaves the canvas, which reaches from ({:g}, {:g}) to ({:g}, {:g}), to "
          "({:g}, {:g}) ({}): poses are extrapolated there",
          canvas.min().x(), canvas.min().y(), canvas.max().x(), canvas.max().y(), at.x(), at.y(),
          cursor_.where[static_cast<std::size_t>(i)]);
    }
    held = held || !limit.contains(at);
    cursor_.at.col(i) = at.cwiseMax(limit.min()).cwiseMin(limit.max());
  }
  if (note.empty()) return;
  notes_.push_back(held ? note +
                              ", up to half of its width and height beyond it, where the cursor "
                              "is held"
                        : note);
}

Eigen::Vector2d PerformedPoses::place(FrameNumber frame) const {
  const Between b = between(cursor_.moments, static_cast<FrameTime>(frame));
  const Eigen::Vector2d from = cursor_.at.col(static_cast<Eigen::Index>(b.from));
  const Eigen::Vector2d to = cursor_.at.col(static_cast<Eigen::Index>(b.to));
  return from + b.share * (to - from);
}

Eigen::VectorXd PerformedPoses::weights(FrameNumber frame) const {
  return keys_.weights(place(frame));
}

std::optional<std::size_t> PerformedPoses::pose_at(FrameNumber frame) const {
  const double extent = (points_.rowwise().maxCoeff() - points_.rowwise().minCoeff()).norm();
  Eigen::Index nearest = 0;
  const Eigen::Vector2d at = place(frame);
  const double distance = (points_.colwise() - at).colwise().norm().minCoeff(&nearest);
  if (distance > 1e-9 * extent) return {};  // moments of frames are rounded
  return static_cast<std::size_t>(nearest);
}

std::vector<PerformedHandle> read_performance(const PerformanceOptions& options, double fps) {
  const CsvTable table = table_of(options.performance, "performance", {"time", "handle", "x", "y"});
  const std::map<std::string, Eigen::Vector2d> places = places_of(options.handles);
  std::vector<PerformedHandle> rows;
  std::map<std::string, double> last;  // time of each handle
  for (std::size_t i = 0; i < table.rows(); ++i) {
    check_after(table, i, true);
    const std::string& name = table.text(i, "handle");
    const auto place = places.find(name);
    if (place == places.end()) {
      throw InputError(fmt::format("{}: unknown handle {}; {}", table.where(i), quote(name),
                                   known_names(name, names_in(places))));
    }
    const double time = table.number(i, "time");
    const auto [seen, is_new] = last.try_emplace(name, time);
    if (!is_new && seen->second == time) {
      throw InputError(fmt::format("{}: handle {} has two rows of time {:g}; keep one",
                                   table.where(i), quote(name), time));
    }
    seen->second = time;
    const bool turns = table.has("angle") && !table.text(i, "angle").empty();
    rows.push_back({.moment = static_cast<FrameTime>(time) * fps,
                    .place = place->second,
                    .target = {table.number(i, "x"), table.number(i, "y")},
                    .turns = turns,
                    .degrees = turns ? table.number(i, "angle") : 0,
                    .where = table.where(i)});
  }
  for (const auto& [name, place] : places) {
    if (last.contains(name)) continue;
    throw InputError(
        fmt::format("'{}' has no row of the handle {}; add one, or take it out of "
                    "'handles'",
                    options.performance.text, quote(name)));
  }
  return rows;
}

}  // namespace deformlab
