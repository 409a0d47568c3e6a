#include "experiments/subjects/particles/particle_writer.h"

#include "geometry/core/error.h"

namespace deformlab {

ParticleWriter::ParticleWriter(const ParticleCache& cache, const std::filesystem::path& out)
    : streams_(cache.streams()),
      kept_(3, streams_ ? 0 : cache.rows()),
      reader_(cache.path()),
      file_(out) {}

void ParticleWriter::add(ParticleFrame rows, const Eigen::Matrix3Xd& positions) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto position = positions.col(static_cast<Eigen::Index>(i));
    if (streams_) {
      write(position);
    } else {
      kept_.col(rows[i].number) = position;
    }
  }
}

void ParticleWriter::write(const Eigen::Vector3d& position) {
  if (!reader_.next()) throw InputError("the particles changed while they were read");
  file_.write(reader_.between());
  file_.write(reader_.moved(position));
}

void ParticleWriter::commit() {
  for (const auto position : kept_.colwise()) write(position);
  reader_.next();
  file_.write(reader_.between());  // the text after the last row
  file_.commit();
}

}  // namespace deformlab
