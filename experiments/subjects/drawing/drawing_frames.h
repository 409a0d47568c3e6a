#pragma once

#include <optional>
#include <set>
#include <string>

#include "drawing/bitmap/webp_movie.h"
#include "experiments/subjects/animation/frame_loop.h"
#include "experiments/subjects/drawing/posed_drawing.h"
#include "experiments/subjects/run_options.h"

namespace deformlab {

/// Where the frames of an animated drawing are written to: one file for each of them, or one
/// animated WebP.
class DrawingFrames {
 public:
  /// Throws InputError for a name that is neither a pattern nor a .webp, and where frames cannot be
  /// written or would replace a file that the command reads or writes.
  DrawingFrames(const CommandLine& command, const FrameRange& range);

  /// A name that says the format of one frame, as deform's --out does.
  std::filesystem::path example() const;

  /// Calls pose(frame) for each frame and writes the drawing as it then is. All frames show `page`.
  /// `fingerprint` stands for all that the files depend on.
  void write(PosedDrawing& drawing, const RunOptions& options, const Page& page,
             const std::string& fingerprint, const std::function<void(FrameNumber)>& pose);
  /// Has to be called at last, when nothing can fail any more.
  void complete();

  int made() const { return made_; }  ///< frames that this run made

 private:
  void write_files(PosedDrawing& drawing, const DrawingOutputOptions& output,
                   const std::string& fingerprint, const std::function<void(FrameNumber)>& pose);
  void write_movie(PosedDrawing& drawing, const RunOptions& options, const Page& page,
                   const std::function<void(FrameNumber)>& pose);

  std::string out_;
  FrameRange range_;
  std::optional<FramePattern> pattern_;  // none: it is a movie
  std::optional<FrameLoop> loop_;
  std::string movie_;  // the bytes of its file
  int made_ = 0;
};

}  // namespace deformlab
