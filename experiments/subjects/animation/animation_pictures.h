#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/picture_options.h"
#include "experiments/subjects/subject.h"
#include "geometry/graph/deformation_graph.h"
#include "render/render.h"

namespace deformlab {

inline constexpr int kMostPictured = 64;  ///< frames in a contact sheet

/// The image sequence of an animation, which is made in addition to its contact sheet.
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

/// Throws InputError if a contact sheet cannot show this number of frames. Messages call the option
/// `name`.
void check_pictured(int pictured, int most, const std::string& name);

/// `count` frames of a range, evenly spread, beginning with the first.
std::vector<FrameNumber> evenly_spread(const FrameRange& range, int count);

/// What a picture shows of one frame of an animation: the input, the output, the handles (3×n)
/// [length], and the vertices that are tinted.
struct SeenFrame {
  Shape input, output;
  Eigen::Matrix3Xd handles;
  std::vector<int> tinted = {};
};

/// The frames of one run that are pictured. They are collected during the run.
template <class Frame>
class Seen {
 public:
  /// The frames of the sheet ascend.
  Seen(const std::vector<FrameNumber>& sheet, const SequenceOptions& sequence)
      : sheet_(sheet), every_(sequence.every) {}

  bool wants(FrameNumber frame) const { return is_in_sheet(frame) || is_in_sequence(frame); }
  void add(FrameNumber frame, Frame seen) { seen_[frame] = std::move(seen); }

  bool is_in_sheet(FrameNumber frame) const { return std::ranges::binary_search(sheet_, frame); }
  bool is_in_sequence(FrameNumber frame) const { return every_ > 0 && frame % every_ == 0; }
  const std::map<FrameNumber, Frame>& all() const { return seen_; }

 private:
  std::vector<FrameNumber> sheet_;
  int every_;
  std::map<FrameNumber, Frame> seen_;
};
using SeenFrames = Seen<SeenFrame>;

/// The pictures of animations. The contact sheet has some frames of the input in one row, and below
/// it the same frames of each run. In a sequence, each picture shows one frame: the input at the
/// left, and beside it the output of each run.
class AnimationBook : public Book {
 public:
  explicit AnimationBook(const PictureOptions& options) : options_(options) {}

  void look_by(const Camera& camera) {
    camera_ = camera;
  }  ///< for all runs that are added from now on
  /// Adds a run. Before the first run its input is added, and the graph at rest is shown in the
  /// first frame of the sheet, if the options ask for them.
  void add(const SeenFrames& frames, const DeformationGraph& graph, const std::string& caption);
  bool empty() const override { return runs_ == 0; }
  Image render() const override;  ///< the contact sheet
  /// The frames that every run has, all with the same size and framing.
  std::vector<Image> sequence(int width) const override;

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
  std::map<FrameNumber, std::vector<Panel>> sequence_;
};

/// What all kinds of animations have in common.
SubjectKind animation_kind();

}  // namespace deformlab
