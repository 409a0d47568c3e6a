#pragma once

#include <vector>

#include "experiments/subjects/animation/coherence.h"

namespace deformlab {

/// What only the frames of a mesh animation allow, one after the other and forgotten: Coherence,
/// and of the worst frame the distortion from the input to the output. Of a region of vertices the
/// same as region.…, and the least and greatest rotation that takes the input best to the output,
/// region.turn_min and _max [degrees].
class MeshMeasurements {
 public:
  explicit MeshMeasurements(std::vector<int> region = {})
      : region_(std::move(region)), coherence_of_region_(region_) {}

  void add(const Shape& input, const Shape& output);
  void interrupt();  ///< the next frame does not follow the last
  Metrics metrics() const;

 private:
  std::vector<int> region_;
  Coherence coherence_, coherence_of_region_;
  Metrics greatest_, least_;
};

}  // namespace deformlab
