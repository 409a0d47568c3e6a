#pragma once

#include <string>
#include <vector>

namespace deformlab {

/// What `deformlab animate` is told by flags.
struct AnimateFlags {
  std::string frames, particles, edit, out, metrics, picture;
  int nodes = 0;  ///< graph.nodes, unless a key=value sets it
};

/// `deformlab animate --frames PATTERN --edit EDIT.yaml --out PATTERN [--nodes N] [key=value]…
/// [--metrics FILE.json] [--picture FILE.png]`, or with `--particles CACHE.csv` and an --out of one
/// file. Frames are read and written one by one, so that memory does not grow with their number. A
/// run that was stopped goes on where it was; then the picture is of all frames, and the metrics of
/// those that are made now, as a note in them says. Returns 1 where the solver could not take a
/// step.
int animate_command(const std::vector<std::string>& arguments, const AnimateFlags& flags);

}  // namespace deformlab
