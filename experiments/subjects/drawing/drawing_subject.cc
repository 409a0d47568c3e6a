#include "experiments/subjects/drawing/drawing_subject.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>

#include "deformers/arap_2d/arap_2d.h"
#include "drawing/binding.h"
#include "drawing/formats.h"
#include "drawing/write_drawing.h"
#include "experiments/config/override.h"
#include "experiments/measure/depth_options.h"
#include "experiments/measure/drawing_measurements.h"
#include "experiments/measure/shortfalls.h"
#include "experiments/subjects/drawing/drawing_pictures.h"
#include "experiments/subjects/drawing/plane_shortfalls.h"
#include "experiments/subjects/run_options.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

Metrics prefixed(const std::string& prefix, const Metrics& metrics) {
  Metrics result;
  for (const auto& [name, value] : metrics) result[prefix + name] = value;
  return result;
}

Metrics mesh_metrics(const DrawingScene& scene) {
  const TriangleQuality q = quality(scene.rest);
  return {{"vertices", static_cast<double>(scene.rest.V.cols())},
          {"triangles", static_cast<double>(scene.rest.F.cols())},
          {"least_angle", q.least_angle},
          {"mean_quality", q.mean}};
}

Metrics way_of_probes(const ConfigNode& probes_at, const DrawingScene& scene,
                      const Eigen::Matrix2Xd& V, double size) {
  const Eigen::Matrix2Xd at = read_probes(probes_at, 2).topRows<2>();
  const Binding probes(scene.rest, Locator(scene.rest), at);
  Eigen::Matrix3Xd way = Eigen::Matrix3Xd::Zero(3, at.cols());
  way.topRows<2>() = probes(V) - at;
  return probe_metrics(way, size);
}

// How far the drawing leaves the line through the first two handles.
Metrics beside_the_line(const DrawingScene& scene, const Shape& rest, const Handles& handles,
                        const Eigen::Matrix2Xd& V) {
  std::vector<int> vertices = handles.fixed;
  vertices.insert(vertices.end(), handles.moved.begin(), handles.moved.end());
  Eigen::Matrix3Xd at(3, std::ssize(vertices) + handles.points.cols());
  at << rest.V(Eigen::all, vertices), handles.points;
  if (at.cols() < 2) return {};
  return off_line(scene.rest, V, at.col(0).head<2>(), at.col(1).head<2>());
}

std::string step_path(const std::string& out, const char* step) {
  return std::filesystem::path(out).replace_extension(fmt::format(".{}.obj", step)).string();
}

void write_steps(const Arap2d& deformer, const Eigen::Matrix3Xi& F, const std::string& out) {
  write_shape(step_path(out, "intermediate"), to_shape({deformer.intermediate(), F}));
  const auto corners = static_cast<int>(F.size());
  const Eigen::VectorXi own = Eigen::VectorXi::LinSpaced(corners, 0, corners - 1);
  write_shape(step_path(out, "fitted"), to_shape({deformer.fitted(), own.reshaped(3, F.cols())}));
}

class DrawingSubject : public Subject {
 public:
  DrawingSubject(const RunOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  void check() const override {
    read_plane_edit(options_.edit);
    check_paint(options_.paint);
    read_cut_lines(options_.cut);
    check_depth_levels(options_.depth.parts);
    read_probes(options_.measure.probes, 2);
  }

  void read() override {
    const std::vector<EditEntry> edit = read_plane_edit(options_.edit);
    scene_ = make_drawing(options_.drawing, context_.folder, edit, read_cut_lines(options_.cut));
    for (const std::string& note : scene_.drawing.notes) LOG(WARNING) << note;
    if (context_.writes()) check_output(context_.command->out, scene_.drawing, options_.output);
    paint(scene_, options_.paint);
    const auto shown = [&](const Eigen::Vector2d& p) { return shows(scene_.drawing, p); };
    edit_ = resolve(on_mesh(edit, scene_.rest, shown), scene_.rest);
    for (const std::string& note : edit_.notes) LOG(WARNING) << note;
    rest_ = to_shape(scene_.rest);
    deformer_ = make_deformer(options_.method, scene_);
    arap_ = dynamic_cast<const Arap2d*>(deformer_.get());
    depth_.emplace(options_.depth, scene_.rest, depth_levels(options_.depth.parts, scene_.rest));
    if (context_.writes() && options_.output.steps) check_steps();
  }

  void deform() override {
    deformer_->compile(edit_.handles);
    drag_ = drag(*deformer_, rest_, edit_, options_.drag, [&] {
      V_ = deformer_->deformed().V.topRows<2>();
      depths_ = depth_->update(V_);
    });
    log_notes(drag_.last, context_);
  }

  const Summary& solve() const override { return drag_.last.solve; }

  std::vector<std::string> shortfalls() const override {
    std::vector<std::string> result;
    if (!options_.drag.back) {  // where handles go back, they are not to be at their targets
      result = missed_handles(scene_, V_, edit_, drag_.last);
    }
    if (!arap_) std::ranges::move(inside_out(drag_.last), std::back_inserter(result));
    return result;
  }

  Run measure() const override {
    const double size = bounding_box_diagonal(rest_.V);
    Run run = run_of(drag_, edit_, deformer_->deformed().V, size);
    const std::vector<std::string>& notes = scene_.drawing.notes;
    run.notes.insert(run.notes.begin(), notes.begin(), notes.end());
    Metrics& metrics = run.measured.metrics;
    if (arap_) {
      metrics.merge(
          prefixed("intermediate.", plane_distortion(scene_.rest, arap_->intermediate())));
    }
    for (const Metrics& part :
         {mesh_metrics(scene_), plane_distortion(scene_.rest, V_), depth_->metrics(V_),
          painted_distortion(scene_.rest, V_, scene_.weights),
          beside_the_line(scene_, rest_, edit_.handles, V_),
          way_of_probes(options_.measure.probes, scene_, V_, size)}) {
      metrics.insert(part.begin(), part.end());
    }
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<DrawingBook&>(book);
    const PicturedDrawing pictured{bound(), scene_.drawing.page, scene_.weights, edit_,
                                   options_.output.page.fixed(scene_.drawing)};
    if (pictures.empty()) pictures.add_rest(pictured);
    if (arap_ && options_.picture.steps) {
      pictures.add_steps(pictured, arap_->intermediate(), arap_->fitted());
    }
    pictures.add_deformed(pictured, V_, depths_, caption);
  }

  void write() override {
    const std::string& out = context_.command->out;
    for (const auto& note : write_drawing(out, *bound(), V_, depths_, options_.output)) {
      LOG(WARNING) << note;
    }
    if (options_.output.steps) write_steps(*arap_, scene_.rest.F, out);
  }

  std::string summary() const override {
    return fmt::format("{} vertices, {} triangles, handles off by {:.3g} rms; written to {}\n",
                       scene_.rest.V.cols(), scene_.rest.F.cols(), drag_.last.handle_rms,
                       context_.command->out);
  }

 private:
  // Throws InputError if the file of a step cannot be written.
  void check_steps() const {
    if (!arap_) {
      throw InputError("output.steps is true, but only deformer=arap_2d has steps");
    }
    const CommandLine& c = *context_.command;
    std::vector<NamedFile> outputs = c.outputs();
    for (const char* step : {"intermediate", "fitted"}) {
      outputs.push_back({step_path(c.out, step), "output.steps"});
    }
    check_outputs(c.inputs, outputs);
  }

  // Binds the drawing to its mesh only if it is needed, because this takes time.
  std::shared_ptr<const BoundDrawing> bound() {
    if (!bound_)
      bound_ = std::make_shared<BoundDrawing>(scene_.drawing, scene_.rest, scene_.following);
    return bound_;
  }

  RunOptions options_;
  RunContext context_;
  DrawingScene scene_;
  Shape rest_;
  ResolvedEdit edit_;
  std::unique_ptr<Deformer> deformer_;
  const Arap2d* arap_ = nullptr;  // the deformer, if it is of this class
  std::optional<DrawingDepth> depth_;
  Eigen::Matrix2Xd V_;      // deformed, 2×#V [length]
  Eigen::VectorXd depths_;  // #F
  DragReport drag_;
  std::shared_ptr<const BoundDrawing> bound_;
};

// A flat mesh is a drawing only if the method for drawings is asked for.
bool is_drawing(const CommandLine& line) {
  const std::string extension = extension_of(line.input);
  if (is_one_of(kImageFormats, extension) || is_one_of(kCurveFormats, extension)) return true;
  for (const char* picture :
       {".svgz", ".gif", ".bmp", ".tif", ".tiff", ".avif", ".heic", ".pdf", ".eps"}) {
    if (extension == picture) return true;  // read_drawing says what to do
  }
  return std::ranges::find(line.overrides, "deformer=arap_2d") != line.overrides.end();
}

}  // namespace

SubjectKind drawing_kind() {
  return {
      .name = "a drawing",
      .flag = "",
      .file_key = "drawing.file",
      .meaningless = {"shape", "animation"},
      .automatic = DeformerKind::kArap2d,
      .is_in = [](const RunOptions& options) { return !options.drawing.file.empty(); },
      .reads = is_drawing,
      .load_edit = put_edit,
      .set_defaults =
          [](const CommandLine& line, ConfigNode& root) {
            apply_override(root, {"drawing.vertices", std::to_string(line.vertices), "."});
          },
      .make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
        return std::make_unique<DrawingSubject>(options, context);
      },
      .make_book = [](const PictureOptions& options) -> std::unique_ptr<Book> {
        return std::make_unique<DrawingBook>(options);
      }};
}

}  // namespace deformlab
