#include <glog/logging.h>

#include <algorithm>
#include <cstdio>

#include "drawing/write_drawing.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/deform_ending.h"
#include "experiments/config/config.h"
#include "experiments/config/override.h"
#include "experiments/measure/depth_options.h"
#include "experiments/subjects/drawing/drawing_pictures.h"
#include "experiments/subjects/methods.h"
#include "experiments/subjects/outputs.h"
#include "experiments/subjects/run.h"
#include "geometry/core/error.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

/// What key=value may set.
struct DrawingDeformOptions {
  DrawingSceneOptions drawing;
  MethodOptions method;
  ConfigNode paint;
  DepthOptions depth;
  DrawingOutputOptions output;
  PictureOptions picture;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("drawing", o.drawing, "How the drawing is read and cut into triangles");
    MethodOptions::fields(o.method, visit);
    visit("paint", o.paint, "Stiff parts: a list of {select, weight} or {mask: FILE.png, weight}");
    visit("depth", o.depth, "Which of two parts is in front where they overlap");
    visit("output", o.output, "How the deformed drawing is written");
    visit("picture", o.picture, "How the file of --picture is drawn");
  }
};

DrawingDeformOptions read_options(const std::vector<std::string>& arguments,
                                  const DeformFlags& flags) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  apply_override(root, {"drawing.vertices", std::to_string(flags.vertices), "."});
  apply_override(root, {"graph.nodes", std::to_string(flags.nodes), "."});
  for (auto text = arguments.begin() + 1; text != arguments.end(); ++text) {
    apply_override(root, parse_override(*text));
  }
  auto options = read_config<DrawingDeformOptions>(root);
  complete_energies(root, options.method.deformation);
  if (!options.drawing.file.empty()) {
    throw InputError("drawing.file is set, but the drawing is the first argument of deform");
  }
  options.drawing.file = arguments.front();
  return options;
}

void print(const Report& report, const DrawingScene& scene, const std::string& out) {
  std::printf("%d vertices, %d triangles, handles off by %.3g rms; written to %s\n",
              static_cast<int>(scene.rest.V.cols()), static_cast<int>(scene.rest.F.cols()),
              report.handle_rms, out.c_str());
}

std::string stage_path(const std::string& out, const char* stage) {
  return fs::path(out).replace_extension(std::string(".") + stage + ".obj").string();
}

// Throws where a file that was asked for could not be written, before the work.
void check_stages(const DrawingDeformOptions& options, const Deformer& deformer,
                  const DeformFlags& flags) {
  if (!options.output.stages) return;
  if (dynamic_cast<const Arap2d*>(&deformer) == nullptr) {
    throw InputError("output.stages is true, but only deformer=arap_2d has stages");
  }
  check_outputs({"", options.drawing.file, flags.edit, flags.out, flags.metrics, flags.picture},
                {{stage_path(flags.out, "intermediate"), "output.stages"},
                 {stage_path(flags.out, "fitted"), "output.stages"}});
}

void write_stages(const Arap2d& deformer, const Eigen::Matrix3Xi& F, const std::string& out) {
  write_shape(stage_path(out, "intermediate"), to_shape({deformer.intermediate(), F}));
  const auto corners = static_cast<int>(F.size());
  const Eigen::VectorXi own = Eigen::VectorXi::LinSpaced(corners, 0, corners - 1);
  write_shape(stage_path(out, "fitted"), to_shape({deformer.fitted(), own.reshaped(3, F.cols())}));
}

}  // namespace

bool is_drawing(const std::vector<std::string>& arguments) {
  const std::string extension = fs::path(arguments.front()).extension().string();
  for (const char* known : {".png", ".svg", ".txt", ".PNG", ".SVG", ".TXT"}) {
    if (extension == known) return true;
  }
  return std::any_of(arguments.begin() + 1, arguments.end(),
                     [](const std::string& text) { return text == "deformer=arap_2d"; });
}

int deform_drawing(const std::vector<std::string>& arguments, const DeformFlags& flags) {
  const DrawingDeformOptions options = read_options(arguments, flags);
  const std::vector<EditEntry> entries = read_plane_edit_file(flags.edit);
  check_paint(options.paint);
  DrawingScene scene = make_drawing(options.drawing, ".");
  for (const std::string& note : scene.drawing.notes) LOG(WARNING) << note;
  check_output(flags.out, scene.drawing);
  paint(scene, options.paint);
  const ResolvedEdit edit = resolve(entries, scene.rest);

  const std::unique_ptr<Deformer> deformer = make_deformer(options.method, scene);
  check_stages(options, *deformer, flags);
  deformer->compile(edit.handles);
  const Report report = deformer->update(edit.targets);
  if (!has_ended_well(report)) return 1;
  const Eigen::Matrix2Xd V = deformer->deformed().V.topRows<2>();
  const Eigen::VectorXd depth = DrawingDepth(options.depth, scene.rest).update(V);
  const PicturedDrawing pictured{std::make_shared<BoundDrawing>(scene.drawing, scene.rest),
                                 scene.weights, edit};
  const auto draw = [&] {
    DrawingBook pictures(options.picture);
    pictures.add_rest(pictured);
    pictures.add_deformed(pictured, V, depth, "deformed");
    return pictures.render();
  };
  write_deformed(report, flags, draw, [&] {
    for (const auto& note : write_drawing(flags.out, *pictured.bound, V, depth, options.output)) {
      LOG(WARNING) << note;
    }
    if (!options.output.stages) return;
    write_stages(dynamic_cast<const Arap2d&>(*deformer), scene.rest.F, flags.out);
  });
  print(report, scene, flags.out);
  return 0;
}

}  // namespace deformlab
