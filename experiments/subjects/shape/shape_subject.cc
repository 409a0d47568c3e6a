#include "experiments/subjects/shape/shape_subject.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include "drawing/formats.h"
#include "experiments/measure/detail.h"
#include "experiments/measure/shortfalls.h"
#include "experiments/measure/stripes.h"
#include "experiments/subjects/run_options.h"
#include "experiments/subjects/shape/cuts.h"
#include "experiments/subjects/shape/paint.h"
#include "experiments/subjects/shape/pictures.h"
#include "geometry/core/error.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

std::vector<int> nearest_vertices(const Shape& shape, const Eigen::Matrix3Xd& points) {
  std::vector<int> result;
  for (const auto p : points.colwise()) {
    Eigen::Index nearest = 0;
    (shape.V.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
    result.push_back(static_cast<int>(nearest));
  }
  return result;
}

void check_input(const std::filesystem::path& input) {
  if (is_shape_file(input)) return;
  const std::string extension = input.extension().string();
  throw InputError(fmt::format(
      "cannot read '{}': {}; shapes are read from .off, .obj, .ply, .stl and .xyz, drawings from "
      "{}, {}; convert it to one of them",
      input.string(),
      extension.empty() ? "its name ends with no format"
                        : fmt::format("the format '{}' is not known", extension),
      fmt::join(kImageFormats, ", "), fmt::join(kCurveFormats, ", ")));
}

class ShapeSubject : public Subject {
 public:
  ShapeSubject(const RunOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  void check() const override {
    if (context_.writes()) check_input(context_.command->input);  // an edit may be for a drawing
    read_edit(options_.edit);
    check_cuts(options_.cut);
    check_shape_paint(options_.paint);
    read_probes(options_.measure.probes, 3);
    if (context_.writes()) check_extension(context_.command->out);
  }

  void read() override {
    rest_ = make_shape(options_.shape, context_.folder);
    edit_ = resolve(read_edit(options_.edit), rest_);
    for (const std::string& note : edit_.notes) LOG(WARNING) << note;
    if (context_.writes() && edit_.handles.targets() == 0) {
      LOG(WARNING) << "the edit moves nothing, because it only has entries with 'fix'";
    }
    MethodOptions method = options_.method;
    method.deformation.stiffness = painted_stiffness(options_.paint, rest_);
    cuts_ = resolve_cuts(options_.cut, rest_);
    deformer_ = make_deformer(method, rest_, cuts_);
  }

  void deform() override {
    deformer_->compile(edit_.handles);
    drag_ = drag(*deformer_, rest_, edit_, options_.drag);
    if (context_.writes()) check_movable(rest_, edit_.handles, edit_.targets, drag_.last);
    log_notes(drag_.last, context_);
  }

  std::vector<std::string> shortfalls() const override {
    const Eigen::Matrix3Xd& V = deformer_->deformed().V;
    std::vector<std::string> result;
    if (!options_.drag.back) {  // where handles go back, they are not to be at their targets
      result = missed_handles(rest_, V, edit_.handles, edit_.targets, drag_.last);
    }
    for (const auto& more : {tears(rest_, V, drag_.last, cuts_), inside_out(drag_.last)}) {
      result.insert(result.end(), more.begin(), more.end());
    }
    return result;
  }

  const Summary& solve() const override { return drag_.last.solve; }

  Run measure() const override {
    const Shape& deformed = deformer_->deformed();
    const double size = bounding_box_diagonal(rest_.V);
    Run run = run_of(drag_, edit_, deformed.V, size);
    Metrics& metrics = run.measured.metrics;
    metrics["components"] = count_components(rest_);
    metrics.merge(distortion(rest_, deformed));
    metrics.merge(region_distortion(rest_, deformed, region_of(options_.measure, rest_)));
    if (options_.measure.detail > 0) {
      metrics.merge(detail(rest_, deformed, options_.measure.detail));
    }
    if (options_.measure.edit) {
      metrics.merge(edge_and_volume_ratios(rest_, deformed));
      const double motion = edit_motion(rest_, edit_.handles, edit_.targets);
      if (motion > 0) metrics["handle_miss"] = drag_.last.handle_max / motion;
    }
    const bool is_plane = options_.shape.file.empty() && options_.shape.rod.sides == 0;
    if (options_.measure.stripes != 0 && is_plane) {
      metrics.merge(stripes(deformed.V, options_.shape.columns, options_.measure.stripes));
    }
    const std::vector<int> probes =
        nearest_vertices(rest_, read_probes(options_.measure.probes, 3));
    const Eigen::Matrix3Xd way = (deformed.V - rest_.V)(Eigen::all, probes);
    metrics.merge(probe_metrics(way, size));
    if (const auto* embedded = as_embedded(*deformer_)) {
      metrics.merge(node_shear(embedded->transformations()));
    }
    return run;
  }

  void draw(Book& book, const std::string& caption) override {
    auto& pictures = dynamic_cast<PictureBook&>(book);
    pictures.look_by(camera_for(options_.picture, rest_.V));
    if (pictures.empty()) pictures.add_rest(*deformer_, rest_, edit_);
    pictures.add_deformed(*deformer_, edit_, caption);
  }

  void write() override {
    const bool is_that_of_the_file = options_.shape.vertices == 0 && options_.shape.scan.views == 0;
    const std::string& source = is_that_of_the_file ? context_.command->input : "";
    write_shape(context_.command->out, deformer_->deformed(), source);
  }

  std::string summary() const override {
    const Report& report = drag_.last;
    const Summary& s = report.solve;
    return fmt::format(
        "{} after {} steps: F {:.6g}, handles off by {:.3g} rms, min det R {:.3g}\n"
        "{} nodes, {} edges, {} unknowns; written to {}\n",
        to_string(s.status), s.iterations.size(), s.final_cost, report.handle_rms, report.min_det_R,
        report.nodes, report.edges, s.unknowns, context_.command->out);
  }

 private:
  RunOptions options_;
  RunContext context_;
  Shape rest_;
  ResolvedEdit edit_;
  std::vector<Cut> cuts_;
  std::unique_ptr<Deformer> deformer_;
  DragReport drag_;
};

}  // namespace

SubjectKind shape_kind() {
  return {
      .name = "a shape",
      .flag = "",
      .file_key = "shape.file",
      .meaningless = {"shape", "drawing", "animation", "depth", "output"},
      .is_in = [](const RunOptions&) { return true; },
      .reads = [](const CommandLine&) { return true; },
      .load_edit = put_edit,
      .set_defaults = [](const CommandLine&, ConfigNode&) {},
      .make = [](const RunOptions& options, const RunContext& context) -> std::unique_ptr<Subject> {
        return std::make_unique<ShapeSubject>(options, context);
      },
      .make_book = [](const PictureOptions& options) -> std::unique_ptr<Book> {
        return std::make_unique<PictureBook>(options);
      }};
}

}  // namespace deformlab
