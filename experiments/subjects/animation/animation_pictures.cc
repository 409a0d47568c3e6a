#include "experiments/subjects/animation/animation_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/subjects/motion/script.h"
#include "geometry/core/options.h"

namespace deformlab {
namespace {

constexpr int kMostPictures = 240;

}  // namespace

void check(const SequenceOptions& o, int frames) {
  const int least = (frames - 1) / kMostPictures + 1;
  if (o.every == 0 || o.every >= least) return;
  throw OptionError(
      "animation.sequence.every", std::to_string(o.every),
      fmt::format("; allowed: 0, or at least {} for {} frames, because there can be {} "
                  "pictures",
                  least, frames, kMostPictures));
}

void check_pictured(int pictured, int most, const std::string& name) {
  if (pictured <= most) return;
  throw OptionError(name, std::to_string(pictured),
                    fmt::format("; allowed: 1 to {}, the number of frames", most));
}

std::vector<FrameNumber> evenly_spread(const FrameRange& range, int count) {
  std::vector<FrameNumber> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(range.first + i * (range.count() / count) +
                     i * (range.count() % count) / count);
  }
  return frames;
}

void AnimationBook::add(const SeenFrames& frames, const DeformationGraph& graph,
                        const std::string& caption) {
  add_to_sheet(frames, graph, caption);
  add_to_sequence(frames, caption);
  ++runs_;
}

Panel AnimationBook::input_panel(const SeenFrame& seen, const std::string& caption) {
  shapes_.push_back(std::make_unique<Shape>(seen.input));
  return {.shape = shapes_.back().get(),
          .vertex_colors = tinted(seen.input, seen.tinted),
          .caption = caption,
          .camera = camera_};
}

Panel AnimationBook::output_panel(const SeenFrame& seen, const std::string& caption) {
  shapes_.push_back(std::make_unique<Shape>(seen.output));
  Panel panel{.shape = shapes_.back().get(),
              .vertex_colors = tinted(seen.output, seen.tinted),
              .caption = caption,
              .camera = camera_};
  const double size = bounding_box_diagonal(seen.output.V);
  add_balls(panel, seen.handles, kHandleRadius * size, colors::kHandle);
  return panel;
}

void AnimationBook::add_to_sheet(const SeenFrames& frames, const DeformationGraph& graph,
                                 const std::string& caption) {
  std::vector<Panel> inputs, outputs;
  for (const auto& [frame, seen] : frames.all()) {
    if (!frames.is_in_sheet(frame)) continue;
    const std::string name = fmt::format("frame {}", frame);
    if (runs_ == 0 && options_.rest) inputs.push_back(input_panel(seen, name));
    outputs.push_back(output_panel(seen, caption + ", " + name));
  }
  columns_ = static_cast<int>(outputs.size());
  if (!inputs.empty() && options_.graph != PicturedGraph::kNone) {
    add_graph(inputs[0], graph, graph.g, kNodeRadius * bounding_box_diagonal(inputs[0].shape->V));
  }
  for (std::vector<Panel>* row : {&inputs, &outputs}) {
    std::ranges::move(*row, std::back_inserter(sheet_));
  }
}

void AnimationBook::add_to_sequence(const SeenFrames& frames, const std::string& caption) {
  for (const auto& [frame, seen] : frames.all()) {
    if (!frames.is_in_sequence(frame)) continue;
    std::vector<Panel>& panels = sequence_[frame];
    const std::string name = fmt::format("frame {}", frame);
    if (panels.empty()) panels.push_back(input_panel(seen, name));
    panels.push_back(output_panel(seen, caption));
  }
}

Image AnimationBook::render() const {
  return render_grid(sheet_, render_options(options_),
                     options_.columns > 0 ? options_.columns : columns_);
}

std::vector<Image> AnimationBook::sequence(int width) const {
  const std::ptrdiff_t columns = runs_ + 1;
  std::vector<Panel> panels;
  for (const auto& [frame, row] : sequence_) {
    if (std::ssize(row) == columns) panels.insert(panels.end(), row.begin(), row.end());
  }
  if (panels.empty()) return {};
  RenderOptions options = render_options(options_);
  options.height = std::max(options.height * width / options.width, 1);
  options.width = width;
  const std::vector<Image> images = render_alike(panels, options);
  std::vector<Image> pictures;
  for (auto row = images.begin(); row != images.end(); row += columns) {
    pictures.push_back(side_by_side({row, row + columns}));
  }
  return pictures;
}

SubjectKind animation_kind() {
  SubjectKind kind{};
  kind.file_key = "animation.file";
  kind.meaningless = {"shape", "drawing", "paint", "cut", "drag", "depth", "output"};
  kind.reads = [](const CommandLine&) { return false; };
  kind.load_edit = put_script;
  kind.set_defaults = [](const CommandLine&, ConfigNode&) {};
  kind.make_book = [](const PictureOptions& options) -> std::unique_ptr<Book> {
    return std::make_unique<AnimationBook>(options);
  };
  return kind;
}

}  // namespace deformlab
