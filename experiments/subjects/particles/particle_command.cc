#include "experiments/subjects/particles/particle_command.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>

#include "experiments/commands/results.h"
#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/progress_line.h"
#include "experiments/subjects/outputs.h"
#include "experiments/subjects/particles/particle_cache.h"
#include "experiments/subjects/particles/stream_log.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

// A copy of the cache with other coordinates, in the order of its rows.
class ParticleWriter {
 public:
  ParticleWriter(const fs::path& source, const fs::path& out) : reader_(source), file_(out) {}

  void write(const Eigen::Vector3d& place) {
    if (!reader_.next()) throw InputError("the particles changed while they were read");
    file_.write(reader_.between());
    file_.write(reader_.moved(place));
  }
  void commit() {
    reader_.next();
    file_.write(reader_.between());  // what follows the last row
    file_.commit();
  }

 private:
  ParticleReader reader_;
  AtomicFile file_;
};

void print(const StreamEditor& editor, const ParticleCache& cache, const std::string& out) {
  std::printf("%d nodes on the path of particle %lld, frames %d to %d\n", editor.nodes(),
              static_cast<long long>(editor.life().id), editor.life().first, editor.life().last);
  std::printf("handles off by %.3g at most; %lld rows of %d frames written to %s\n",
              editor.worst_handle(), static_cast<long long>(cache.rows()), cache.frames().count(),
              out.c_str());
}

// The edited places of a frame go to the file at once, or wait for their turn.
class Rows {
 public:
  Rows(const ParticleCache& cache, ParticleWriter& writer)
      : streams_(cache.streams()), writer_(writer), kept_(3, streams_ ? 0 : cache.rows()) {}

  void add(ParticleFrame rows, const Eigen::Matrix3Xd& places) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto place = places.col(static_cast<Eigen::Index>(i));
      if (streams_) {
        writer_.write(place);
      } else {
        kept_.col(rows[i].number) = place;
      }
    }
  }
  void commit() {
    for (const auto place : kept_.colwise()) writer_.write(place);
    writer_.commit();
  }

 private:
  bool streams_;
  ParticleWriter& writer_;
  Eigen::Matrix3Xd kept_;
};

// Told of each frame that is done.
using Done = std::function<void(int frame, ParticleFrame, const Eigen::Matrix3Xd& edited)>;

// Edits frame by frame. Returns whether all were solved.
bool edit_frames(const ParticleCache& cache, StreamEditor& editor, const Done& done) {
  std::set<std::string> told;
  bool good = true;
  ProgressLine progress("animate: frame");
  cache.for_each_frame([&](int frame, ParticleFrame rows) {
    if (!good) return;
    const Eigen::Matrix3Xd edited = editor.edited(frame, rows);
    good = editor.report().solve.status != Status::kFailed;
    for (const std::string& note : editor.report().notes) {
      if (told.insert(note).second) LOG(WARNING) << note;
    }
    if (good) done(frame, rows, edited);
    progress.show(frame - cache.frames().first + 1, cache.frames().count());
  });
  return good;
}

Image draw(const SeenFrames& seen, const StreamEditor& editor, const PictureOptions& options) {
  AnimationBook book(options);
  book.add(seen, editor.stream().deformation().graph(), "edited");
  return book.sheet();
}

}  // namespace

int animate_particles(const AnimateFlags& flags, const AnimateOptions& options) {
  check_outputs({flags.particles, flags.edit},
                {{flags.out, "--out"}, {flags.metrics, "--metrics"}, {flags.picture, "--picture"}});
  const Script script = read_script_file(flags.edit);
  const ParticleCache cache(flags.particles);
  if (!cache.streams()) LOG(WARNING) << "the rows are not in order of frames: all are kept at once";
  StreamEditor editor(cache, script, options.deformation, options.path);
  ParticleWriter writer(flags.particles, flags.out);
  Rows edited(cache, writer);
  StreamLog log;
  const int pictured =
      flags.picture.empty() ? 0 : std::min(options.pictured, cache.frames().count());
  SeenFrames seen(evenly_spread(cache.frames(), pictured), {});
  const bool good =
      edit_frames(cache, editor, [&](int frame, ParticleFrame rows, const auto& places) {
        edited.add(rows, places);
        if (!flags.metrics.empty()) log.add(editor, rows, places);
        if (!seen.wants(frame)) return;
        seen.add(frame, {as_points(places_of(rows)), as_points(places), editor.handles()});
      });
  if (!good) {
    std::fprintf(stderr, "deformlab: the solver failed: %s; nothing was written\n",
                 editor.report().solve.message.c_str());
    return 1;
  }
  Image picture;  // drawn before the first file is written, as drawing may fail
  if (pictured > 0) picture = draw(seen, editor, options.picture);
  edited.commit();
  if (!flags.metrics.empty()) write_file(flags.metrics, to_json(log.run(editor)));
  if (pictured > 0) write_png(picture, flags.picture);
  print(editor, cache, flags.out);
  return 0;
}

}  // namespace deformlab
