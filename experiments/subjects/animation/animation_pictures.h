#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/picture_options.h"
#include "geometry/graph/deformation_graph.h"
#include "render/render.h"

namespace deformlab {

inline constexpr int kMostPictured = 64;  ///< frames in a contact sheet

/// An animation as an image sequence, beside its contact sheet.
struct SequenceOptions {
  int every = 0;
  int width = 200;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("every", o.every, {.min = 0},
                "A picture is made of the first of every so many frames; 0 makes none");
    visit.range("width", o.width, {.min = 16, .max = 1024},
                "The width of one panel, to which its height is in proportion [pixel]");
  }
};

/// Throws InputError for options out of range, and for more pictures of `frames` than can be kept.
void check(const SequenceOptions& options, int frames);

/// Throws InputError where a contact sheet cannot show so many frames; `name` is what messages call
/// the option.
void check_pictured(int pictured, int most, const std::string& name);

/// `count` frames of a range, evenly spread from the first on.
std::vector<int> evenly_spread(const FrameRange& range, int count);

/// What is seen of an animation in one frame: the input, the output, its handles, 3×n [length], and
/// which vertices are tinted.
struct SeenFrame {
  Shape input, output;
  Eigen::Matrix3Xd handles;
  std::vector<int> tinted = {};
};

/// Those frames of one run that are pictured, collected while it runs.
class SeenFrames {
 public:
  SeenFrames(const std::vector<int>& sheet, const SequenceOptions& sequence);

  bool wants(int frame) const { return is_in_sheet(frame) || is_in_sequence(frame); }
  void add(int frame, SeenFrame seen) { seen_[frame] = std::move(seen); }

  bool is_in_sheet(int frame) const;
  bool is_in_sequence(int frame) const { return every_ > 0 && frame % every_ == 0; }
  const std::map<int, SeenFrame>& all() const { return seen_; }

 private:
  std::vector<int> sheet_;
  int every_;
  std::map<int, SeenFrame> seen_;
};

/// The pictures of an animation. Its contact sheet has some frames of the input in one row, and
/// below it the same frames of each run; in a sequence each picture is of one frame, the input at
/// the left and beside it what each run made of it.
class AnimationBook {
 public:
  explicit AnimationBook(const PictureOptions& options) : options_(options) {}

  void look_by(const Camera& camera) { camera_ = camera; }  ///< at the runs to come
  /// Adds a run, and before the first its input, with the graph (at rest in the first frame of the
  /// sheet), where the options ask for them.
  void add(const SeenFrames& frames, const DeformationGraph& graph, const std::string& caption);
  bool empty() const { return runs_ == 0; }
  Image sheet() const;
  /// All of one size and framing, panels of `width` [pixel]; only of frames that every run has.
  std::vector<Image> sequence(int width) const;

 private:
  Panel input_panel(const SeenFrame& seen, const std::string& caption);
  Panel output_panel(const SeenFrame& seen, const std::string& caption);
  void add_to_sheet(const SeenFrames& frames, const DeformationGraph& graph,
                    const std::string& caption);
  void add_to_sequence(const SeenFrames& frames, const std::string& caption);

  PictureOptions options_;
  std::optional<Camera> camera_;
  int runs_ = 0, columns_ = 1;
  std::vector<std::unique_ptr<Shape>> shapes_;  // the panels point at them
  std::vector<Panel> sheet_;                    // row by row
  std::map<int, std::vector<Panel>> sequence_;
};

}  // namespace deformlab
