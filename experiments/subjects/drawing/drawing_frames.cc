#include "experiments/subjects/drawing/drawing_frames.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include "experiments/config/suggest.h"
#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/animation/progress_line.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr const char* kMovie = ".webp";

bool is_movie(const std::string& out) {
  return extension_of(out) == kMovie && out.find('%') == std::string::npos;
}

FramePattern pattern_of(const std::string& out) {
  if (out.find('%') != std::string::npos) {
    if (extension_of(out) != kMovie) return {out, "--out"};
    throw InputError(fmt::format(
        "--out {}: a WebP holds all frames in one file; leave the number out: 'movie.webp', or "
        "write 'frame-%03d.png'",
        quote(out)));
  }
  throw InputError(
      fmt::format("--out {}: an animation has many frames: give a name with a number, such as "
                  "'frame-%03d.png', or the name of one animated file, such as 'movie.webp'",
                  quote(out)));
}

}  // namespace

DrawingFrames::DrawingFrames(const CommandLine& command, const FrameRange& range)
    : out_(command.out), range_(range) {
  if (is_movie(out_)) return;
  pattern_.emplace(pattern_of(out_));
  for (const auto& [path, flag] : {std::pair(command.metrics, "--metrics"),
                                   {command.picture, "--picture"},
                                   {command.edit, "--edit"},
                                   {command.input, "the drawing"}}) {
    check_no_frame(path, flag, *pattern_);
  }
  check_written_frames(command, *pattern_, range_, {});
}

std::filesystem::path DrawingFrames::example() const {
  return pattern_ ? pattern_->path(range_.first)
                  : std::filesystem::path(out_).replace_extension(".png");
}

void DrawingFrames::write(PosedDrawing& drawing, const RunOptions& options, const Page& page,
                          const std::string& fingerprint,
                          const std::function<void(FrameNumber)>& pose) {
  DrawingOutputOptions output = options.output;
  output.page.box = page;
  if (pattern_) {
    write_files(drawing, output, fingerprint, pose);
  } else {
    write_movie(drawing, options, page, pose);
  }
}

// The frames that an earlier run has made are posed as well, because the order in depth of a frame
// depends on the frame before.
void DrawingFrames::write_files(PosedDrawing& drawing, const DrawingOutputOptions& output,
                                const std::string& fingerprint,
                                const std::function<void(FrameNumber)>& pose) {
  std::set<std::string> told;
  loop_.emplace(*pattern_, fingerprint);
  const auto make = [&](FrameNumber frame) {
    pose(frame);
    for (const std::string& note : write_drawing(pattern_->path(frame), *drawing.bound(),
                                                 drawing.V(), drawing.depths(), output)) {
      if (told.insert(note).second) LOG(WARNING) << note;
    }
    return true;
  };
  loop_->run(range_, make, pose);
  made_ = loop_->made();
}

void DrawingFrames::write_movie(PosedDrawing& drawing, const RunOptions& options, const Page& page,
                                const std::function<void(FrameNumber)>& pose) {
  const KeyframesOptions& keys = options.animation.keyframes;
  std::optional<WebpMovie> movie;
  ProgressLine progress("animate: frame");
  for (FrameNumber i = 0; i < range_.count(); ++i) {
    pose(range_.first + i);
    const Bitmap picture =
        picture_of(out_, *drawing.bound(), drawing.V(), drawing.depths(), page, options.output);
    if (!movie) movie.emplace(picture.width, picture.height, keys.fps, keys.loop);
    movie->add(picture);
    progress.show(i + 1, range_.count());
  }
  movie_ = movie->finish();
  made_ = static_cast<int>(range_.count());
}

void DrawingFrames::complete() {
  if (loop_) {
    loop_->complete();
  } else {
    write_file(out_, movie_);
  }
}

}  // namespace deformlab
