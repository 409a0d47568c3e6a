#include "experiments/animation/particle_command.h"

#include <glog/logging.h>
#include <unistd.h>

#include <cstdio>
#include <set>

#include "experiments/animation/particle_cache.h"
#include "experiments/animation/progress_line.h"
#include "experiments/animation/stream_editor.h"
#include "experiments/outputs.h"
#include "geometry/error.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

// A copy of the cache with other coordinates, in the order of its rows.
class ParticleWriter {
 public:
  ParticleWriter(const fs::path& source, fs::path out)
      : out_(std::move(out)),
        partial_(out_.string() + ".partial" + std::to_string(getpid())),
        reader_(source),
        file_(partial_, std::ios::binary) {}
  ~ParticleWriter() {
    std::error_code ignored;
    fs::remove(partial_, ignored);
  }
  ParticleWriter(const ParticleWriter&) = delete;
  ParticleWriter& operator=(const ParticleWriter&) = delete;

  void write(const Eigen::Vector3d& place) {
    if (!reader_.next()) throw InputError("the particles changed while they were read");
    file_ << reader_.between() << reader_.moved(place);
  }
  void commit() {
    reader_.next();
    file_ << reader_.between();  // what follows the last row
    file_.close();
    std::error_code error;
    if (file_) fs::rename(partial_, out_, error);
    if (!file_ || error)
      throw InputError("cannot write '" + out_.string() + "': is the disk full?");
  }

 private:
  fs::path out_, partial_;
  ParticleReader reader_;
  std::ofstream file_;
};

void print(const StreamEditor& editor, const ParticleCache& cache, const std::string& out) {
  std::printf("%d nodes on the path of particle %lld, frames %d to %d\n", editor.nodes(),
              static_cast<long long>(editor.life().id), editor.life().first, editor.life().last);
  std::printf("handles off by %.3g at most; %lld rows of %d frames written to %s\n",
              editor.worst_handle(), static_cast<long long>(cache.rows()), cache.frames().count(),
              out.c_str());
}

}  // namespace

int animate_particles(const AnimateFlags& flags, const AnimateOptions& options) {
  check_outputs({flags.particles, flags.edit}, {{flags.out, "--out"}});
  const Script script = read_script_file(flags.edit);
  const ParticleCache cache(flags.particles);
  if (!cache.streams()) LOG(WARNING) << "the rows are not in order of frames: all are kept at once";
  StreamEditor editor(cache, script, options.deformation, options.path);
  ParticleWriter writer(flags.particles, flags.out);
  Eigen::Matrix3Xd kept(3, cache.streams() ? 0 : cache.rows());
  std::set<std::string> told;
  bool good = true;
  {
    ProgressLine progress("animate: frame");
    cache.for_each_frame([&](int frame, ParticleFrame rows) {
      if (!good) return;
      const Eigen::Matrix3Xd places = editor.edited(frame, rows);
      good = editor.report().solve.status != Status::kFailed;
      for (const std::string& note : editor.report().notes) {
        if (told.insert(note).second) LOG(WARNING) << note;
      }
      for (std::size_t i = 0; good && i < rows.size(); ++i) {
        const auto place = places.col(static_cast<Eigen::Index>(i));
        if (cache.streams()) {
          writer.write(place);
        } else {
          kept.col(rows[i].number) = place;
        }
      }
      progress.show(frame - cache.frames().first + 1, cache.frames().count());
    });
  }
  if (!good) {
    std::fprintf(stderr, "deformlab: the solver failed: %s; nothing was written\n",
                 editor.report().solve.message.c_str());
    return 1;
  }
  for (const auto place : kept.colwise()) writer.write(place);
  writer.commit();
  print(editor, cache, flags.out);
  return 0;
}

}  // namespace deformlab
