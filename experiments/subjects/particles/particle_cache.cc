#include "experiments/subjects/particles/particle_cache.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <unordered_map>

#include "geometry/core/error.h"
#include "geometry/core/options.h"

namespace deformlab {
namespace {

bool is_before(const ParticleRow& a, const ParticleRow& b) { return a.frame < b.frame; }

// Finds the life to sample. Lives that have ended are compared and removed, so that no more are
// kept than there are particles in a frame.
class Longest {
 public:
  explicit Longest(std::optional<std::int64_t> id) : id_(id) {}

  void add(FrameNumber frame, ParticleFrame particles) {
    for (const ParticleRow& row : particles) {
      if (id_ && row.id != *id_) continue;
      const ParticleLife born{row.id, frame, frame, row.position, row.position};
      ParticleLife& now = living_.try_emplace(row.id, born).first->second;
      now.travelled += (row.position - now.end).norm();
      now.last = frame;
      now.end = row.position;
    }
    std::erase_if(living_, [&](const auto& life) {
      const bool ended = life.second.last < frame;
      if (ended) compare(life.second);
      return ended;
    });
  }

  std::optional<ParticleLife> result() {
    for (const auto& [id, life] : living_) compare(life);
    return best_;
  }

 private:
  // Compares ids too, so that the result does not depend on the order of a hash table.
  static auto merit(const ParticleLife& life) {
    const double way = (life.end - life.begin).norm();
    return std::tuple(frames_between(life.first, life.last), way > 0 ? way / life.travelled : 0,
                      ~life.id);
  }
  void compare(const ParticleLife& life) {
    if (!best_ || merit(life) > merit(*best_)) best_ = life;
  }

  std::optional<std::int64_t> id_;
  std::unordered_map<std::int64_t, ParticleLife> living_;
  std::optional<ParticleLife> best_;
};

}  // namespace

Eigen::Matrix3Xd positions_of(ParticleFrame rows) {
  Eigen::Matrix3Xd positions(3, std::ssize(rows));
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    positions.col(i) = rows[static_cast<std::size_t>(i)].position;
  }
  return positions;
}

Shape as_points(const Eigen::Matrix3Xd& positions) {
  return {positions, Eigen::Matrix3Xd(3, 0), {}};
}

ParticleCache::ParticleCache(std::filesystem::path path) : path_(std::move(path)) {
  ParticleReader reader(path_);
  bool ordered = true;
  while (const auto row = reader.next()) {
    if (rows_++ == 0) frames_ = {row->frame, row->frame};
    ordered = ordered && row->frame >= frames_.last;
    frames_ = {std::min(frames_.first, row->frame), std::max(frames_.last, row->frame)};
  }
  if (rows_ == 0) {
    const char* why = reader.missing() > 0
                          ? "no particle with a position: a coordinate of each is NaN"
                          : "no particles, only a header";
    throw InputError(fmt::format("'{}' has {}", path_.string(), why));
  }
  if (reader.missing() > 0) {
    LOG(WARNING) << fmt::format(
        "{}: {} of {} rows have no position (NaN): they stay as they are in the output",
        path_.string(), reader.missing(), rows_ + reader.missing());
  }
  if (!ordered) keep();
  for_each_frame([&](int, ParticleFrame frame) { check_ids(frame); });
}

void ParticleCache::keep() {
  ParticleReader reader(path_);
  while (const auto row = reader.next()) kept_.push_back(*row);
  std::stable_sort(kept_.begin(), kept_.end(), is_before);
}

void ParticleCache::check_ids(ParticleFrame frame) const {
  std::unordered_map<std::int64_t, std::int64_t> lines;
  for (const ParticleRow& row : frame) {
    const auto [first, is_new] = lines.emplace(row.id, row.line);
    if (is_new) continue;
    throw InputError(fmt::format(
        "particle {} is twice in frame {}, in lines {} and {} of '{}'; give one of them another id",
        row.id, row.frame, first->second, row.line, path_.string()));
  }
}

void ParticleCache::stream(const Visit& visit) const {
  ParticleReader reader(path_);
  std::vector<ParticleRow> frame;
  while (const auto row = reader.next()) {
    if (!frame.empty() && row->frame != frame.front().frame) {
      visit(frame.front().frame, frame);
      frame.clear();
    }
    frame.push_back(*row);
  }
  if (!frame.empty()) visit(frame.front().frame, frame);
}

void ParticleCache::for_each_frame(const Visit& visit) const {
  if (streams()) return stream(visit);
  for (auto begin = kept_.begin(); begin != kept_.end();) {
    const auto end = std::upper_bound(begin, kept_.end(), *begin, is_before);
    visit(begin->frame, {begin, end});
    begin = end;
  }
}

ParticleLife find_path(const ParticleSource& particles, std::optional<std::int64_t> id) {
  Longest longest(id);
  particles.for_each_frame(
      [&](FrameNumber frame, ParticleFrame rows) { longest.add(frame, rows); });
  const std::optional<ParticleLife> life = longest.result();
  if (!life) {
    throw InputError(
        fmt::format("particle {} (path) has no frame in {}; name one that occurs there", *id,
                    particles.name()));
  }
  if (life->begin == life->end) {
    throw InputError(
        fmt::format("particle {}, on whose path the nodes would be sampled, does not move "
                    "in {}; name another with animation.path=ID",
                    life->id, particles.name()));
  }
  return *life;
}

Eigen::Matrix3Xd sample_path(const ParticleSource& particles, const ParticleLife& life, int m) {
  check_number("graph.nodes", m, {.min = 1});
  Eigen::Matrix3Xd samples(3, m);
  const double duration = frames_between(life.first, life.last);
  const auto time = [&](int j) { return m == 1 ? 0 : duration * j / (m - 1); };  // since its begin
  int next = 0;
  double before = 0;
  Eigen::Vector3d from = life.begin;
  particles.for_each_frame([&](FrameNumber frame, ParticleFrame rows) {
    if (frame < life.first || frame > life.last) return;
    const auto row = std::ranges::find(rows, life.id, &ParticleRow::id);
    const double now = frames_between(life.first, frame);
    for (; next < m && (time(next) <= now || frame == life.last); ++next) {
      const double share = now > before ? std::min((time(next) - before) / (now - before), 1.0) : 1;
      samples.col(next) = (1 - share) * from + share * row->position;
    }
    before = now;
    from = row->position;
  });
  return samples;
}

}  // namespace deformlab
