#pragma once

#include <vector>

#include "experiments/animation/coherence.h"

namespace deformlab {

/// What only the frames of a mesh animation allow, one after the other and forgotten: Coherence,
/// and of the worst frame the distortion from the input to the output. Of the vertices that are
/// watched the same alone, as watched.COHERENCE, watched.edge_error (of the worst frame), and the
/// least and greatest rotation that takes the input best to the output, watched.turn_min and _max
/// [degrees].
class MeshMeasurements {
 public:
  explicit MeshMeasurements(std::vector<int> watched = {})
      : watched_(std::move(watched)), coherence_of_watched_(watched_) {}

  void add(const Shape& input, const Shape& output);
  void interrupt();  ///< the next frame does not follow the last
  Metrics metrics() const;

 private:
  std::vector<int> watched_;
  Coherence coherence_, coherence_of_watched_;
  Metrics greatest_, least_;
};

}  // namespace deformlab
