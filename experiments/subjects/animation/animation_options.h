#pragma once

#include <array>
#include <optional>
#include <string>

#include "experiments/subjects/animation/animation_pictures.h"
#include "experiments/subjects/animation/frame_source.h"
#include "experiments/subjects/motion/script.h"

namespace deformlab {

/// The animations that can be generated: a quadruped that gallops, or a jet of particles.
enum class AnimationGenerator { kNone, kGallop, kJet };
constexpr auto names_of(AnimationGenerator) {
  using enum AnimationGenerator;
  return std::to_array<EnumName<AnimationGenerator>>(
      {{kNone, "none"}, {kGallop, "gallop"}, {kJet, "jet"}});
}

/// The animation that a config edits instead of a shape.
struct AnimationOptions {
  AnimationGenerator generator = AnimationGenerator::kNone;
  std::string file;
  int frames = 24;
  double cycle = 24;    ///< frames of one cycle of a gait
  double bend = 0;      ///< how far the jet turns upwards [degree]
  double cell = 0.031;  ///< mean distance of the quadruped's vertices [length]
  KeyframesOptions keyframes;
  std::optional<std::int64_t> path;
  int pictured = 6;
  SequenceOptions sequence;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("generator", o.generator,
          "The animation: a quadruped that gallops, or a jet of particles; none: the config is "
          "about a shape or a drawing");
    visit("file", o.file,
          "Files instead of a generated animation: the frames of a mesh (horse-%03d.obj), or a "
          "table of particles (.csv)");
    visit.range("frames", o.frames, {.min = 1, .max = 10'000},
                "The number of frames of a generated animation");
    visit.range("cycle", o.cycle, {.min = 0, .exclusive_min = true},
                "The length of one cycle of the gait [frame]");
    visit.range("cell", o.cell, {.min = 0.01, .max = 0.06},
                "The mean distance of the quadruped's vertices; the quadruped is about 2.7 long "
                "[length]");
    visit.range("bend", o.bend, {.min = 0, .max = 180},
                "How far the jet turns upwards over its length [degree]");
    KeyframesOptions::fields(o.keyframes, visit);
    visit("path", o.path,
          "The id of the particle whose path carries the graph; by default a particle with a long "
          "and straight path is chosen");
    visit.range("pictured", o.pictured, {.min = 1, .max = kMostPictured},
                "The number of frames in the picture, evenly spread over the animation");
    visit("sequence", o.sequence,
          "Pictures of single frames, which are written to a folder beside the picture");
  }
};

/// Throws InputError for options that no animation supports, for a method other than embedded
/// deformation, and for edits that read_script does not accept.
void check_animation(const RunOptions& options, const RunContext& context);

/// Throws InputError if frames cannot be written to `out`, or if one of them, or the file that says
/// how far a stopped command came, is a file that the command reads or writes beside them or is in
/// `inputs`.
void check_written_frames(const CommandLine& command, const FramePattern& out,
                          const FrameRange& range, std::vector<NamedFile> inputs);

/// Throws InputError if a file that a command reads or writes beside the frames is a frame, or is
/// the file that says how far a stopped command came.
void check_files(const CommandLine& command, const FrameFiles& frames, const FramePattern& out);

/// What messages call the option that names the files: "--FLAG" of a command, or animation.file.
std::string name_of_file(const RunContext& context, const std::string& flag);

/// Throws InputError if a command, which writes one picture, is asked for a sequence of them.
void check_one_sheet(const AnimationOptions& options);

/// The frames of the contact sheet of a run; none for a command without a picture.
std::vector<FrameNumber> sheet_frames(const AnimationOptions& options, const FrameRange& range,
                                      const RunContext& context);

/// The frames that the pictures of a run show; none for a command without a picture.
SeenFrames frames_to_see(const AnimationOptions& options, const FrameRange& range,
                         const RunContext& context);

}  // namespace deformlab
