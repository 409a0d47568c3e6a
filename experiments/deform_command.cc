#include <glog/logging.h>

#include <cstdio>

#include "experiments/commands.h"
#include "experiments/config.h"
#include "experiments/edit.h"
#include "experiments/override.h"
#include "experiments/pictures.h"
#include "experiments/results.h"
#include "geometry/error.h"
#include "geometry/shape_io.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

// A file that is to be written needs its folder: said before the work, not after it.
void check_folder(const std::string& file, const char* flag) {
  if (file.empty()) return;
  const fs::path folder = fs::path(file).parent_path();
  std::error_code error;
  if (fs::is_directory(folder.empty() ? "." : folder, error)) return;
  throw InputError(std::string(flag) + " '" + file + "': there is no folder '" + folder.string() +
                   "'; make it first");
}

EmbeddedDeformationOptions read_options(const std::vector<std::string>& overrides, int nodes) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  apply_override(root, {"graph.nodes", std::to_string(nodes), "."});
  for (const std::string& text : overrides) apply_override(root, parse_override(text));
  auto options = read_config<EmbeddedDeformationOptions>(root);
  complete_energies(root, options);
  return options;
}

void draw(const EmbeddedDeformation& deformer, const Shape& rest, const ResolvedEdit& edit,
          const std::string& path) {
  PictureBook pictures{PictureOptions{}};
  pictures.add_rest(deformer, rest, edit);
  pictures.add_deformed(deformer, edit, "deformed");
  write_png(pictures.render(), path);
}

void print(const Report& report, const std::string& out) {
  const Summary& s = report.solve;
  std::printf("%s after %zu steps: F %.6g -> %.6g, handles off by %.3g rms, min det R %.3g\n",
              to_string(s.status), s.iterations.size(), s.initial_cost, s.final_cost,
              report.handle_rms, report.min_det_R);
  std::printf("%d nodes, %d edges, %d unknowns; written to %s\n", report.nodes, report.edges,
              s.unknowns, out.c_str());
}

}  // namespace

int deform_command(const std::vector<std::string>& arguments, const DeformFlags& flags) {
  if (arguments.empty() || flags.edit.empty() || flags.out.empty()) {
    throw InputError(
        "deform needs a shape, an edit and an output: "
        "deformlab deform SHAPE --edit EDIT.yaml --out OUT [key=value]…");
  }
  check_folder(flags.out, "--out");
  check_folder(flags.metrics, "--metrics");
  check_folder(flags.picture, "--picture");
  const auto options = read_options({arguments.begin() + 1, arguments.end()}, flags.nodes);
  const std::vector<EditEntry> entries = read_edit_file(flags.edit);
  const Shape rest = read_shape(arguments.front());
  const ResolvedEdit edit = resolve(entries, rest);

  EmbeddedDeformation deformer(rest, options);
  deformer.compile(edit.handles);
  const Report report = deformer.update(edit.targets);
  for (const std::string& note : report.notes) LOG(WARNING) << note;
  if (report.solve.status == Status::kFailed) {
    std::fprintf(stderr, "deformlab: the solver failed: %s; nothing was written\n",
                 report.solve.message.c_str());
    return 1;
  }
  if (report.solve.status != Status::kConverged) LOG(WARNING) << report.solve.message;
  write_shape(flags.out, deformer.deformed(), arguments.front());
  if (!flags.metrics.empty()) write_text(flags.metrics, to_json(report));
  if (!flags.picture.empty()) draw(deformer, rest, edit, flags.picture);
  print(report, flags.out);
  return 0;
}

}  // namespace deformlab
