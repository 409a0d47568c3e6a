#include "experiments/subjects/drawing/drawing_subject.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>

#include "deformers/arap_2d/arap_2d.h"
#include "drawing/binding.h"
#include "drawing/formats.h"
#include "drawing/write_drawing.h"
#include "experiments/measure/drawing_measurements.h"
#include "experiments/subjects/drawing/drawing_pictures.h"
#include "experiments/subjects/drawing/plane_shortfalls.h"
#include "experiments/subjects/drawing/posed_drawing.h"
#include "experiments/subjects/run_options.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

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
    check_drawing_options(options_);
  }

  void read() override {
    const std::vector<EditEntry> edit = read_plane_edit(options_.edit);
    drawing_.emplace(options_, context_, edit);
    edit_ = drawing_->resolve(edit);
    for (const std::string& note : edit_.notes) LOG(WARNING) << note;
    if (context_.writes() && options_.output.steps) check_steps();
  }

  void deform() override {
    deformer().compile(edit_.handles);
    drag_ = drag(deformer(), drawing_->rest(), edit_, options_.drag, [&] { drawing_->show(); });
    log_notes(drag_.last, context_);
  }

  const Summary& solve() const override { return drag_.last.solve; }

  std::vector<std::string> shortfalls() const override {
    std::vector<std::string> result;
    if (!options_.drag.back) {  // where handles go back, they are not to be at their targets
      result = missed_handles(scene(), drawing_->V(), edit_, drag_.last);
    }
    std::ranges::move(inside_out(scene(), drawing_->V(), drag_.last), std::back_inserter(result));
    return result;
  }

  Run measure() const override {
    const Eigen::Matrix2Xd& V = drawing_->V();
    const double size = bounding_box_diagonal(drawing_->rest().V);
    Run run = run_of(drag_, edit_, deformer().deformed().V, size);
    const std::vector<std::string>& notes = scene().drawing.notes;
    run.notes.insert(run.notes.begin(), notes.begin(), notes.end());
    Metrics& metrics = run.measured.metrics;
    for (const Metrics& part :
         {drawing_->metrics(), beside_the_line(scene(), drawing_->rest(), edit_.handles, V),
          way_of_probes(options_.measure.probes, scene(), V, size)}) {
      metrics.insert(part.begin(), part.end());
    }
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<DrawingBook&>(book);
    const PicturedDrawing pictured = drawing_->pictured(edit_);
    if (pictures.empty()) pictures.add_rest(pictured);
    if (drawing_->arap() && options_.picture.steps) {
      pictures.add_steps(pictured, drawing_->arap()->intermediate(), drawing_->arap()->fitted());
    }
    pictures.add_deformed(pictured, drawing_->V(), drawing_->depths(), caption);
  }

  void write() override {
    const std::string& out = context_.command->out;
    for (const auto& note : write_drawing(out, *drawing_->bound(), drawing_->V(),
                                          drawing_->depths(), options_.output)) {
      LOG(WARNING) << note;
    }
    if (options_.output.steps) write_steps(*drawing_->arap(), scene().rest.F, out);
  }

  std::string summary() const override {
    return fmt::format("{} vertices, {} triangles, handles off by {:.3g} rms; written to {}\n",
                       scene().rest.V.cols(), scene().rest.F.cols(), drag_.last.handle_rms,
                       context_.command->out);
  }

 private:
  const DrawingScene& scene() const { return drawing_->scene(); }
  Deformer& deformer() const { return drawing_->deformer(); }

  // Throws InputError if the file of a step cannot be written.
  void check_steps() const {
    if (!drawing_->arap()) {
      throw InputError("output.steps is true, but only deformer=arap_2d has steps");
    }
    const CommandLine& c = *context_.command;
    std::vector<NamedFile> outputs = c.outputs();
    for (const char* step : {"intermediate", "fitted"}) {
      outputs.push_back({step_path(c.out, step), "output.steps"});
    }
    check_outputs(c.inputs, outputs);
  }

  RunOptions options_;
  RunContext context_;
  std::optional<PosedDrawing> drawing_;
  ResolvedEdit edit_;
  DragReport drag_;
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
      .set_defaults = set_drawing_defaults,
      .make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
        return std::make_unique<DrawingSubject>(options, context);
      },
      .make_book = make_drawing_book};
}

}  // namespace deformlab
