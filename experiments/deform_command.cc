#include <glog/logging.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

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

// What is to be written is tried before the work, not after it.
void check_output(const std::string& file, const char* flag) {
  if (file.empty()) return;
  const std::string cannot = "cannot write '" + file + "' (" + flag + "): ";
  const fs::path folder = fs::path(file).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder.empty() ? "." : folder, error)) {
    throw InputError(cannot + "there is no folder '" + folder.string() + "'; make it first");
  }
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw InputError(cannot + "it is a folder or a device; name a file");
  }
  const fs::path trial = file + ".partial" + std::to_string(getpid());
  if (!std::ofstream(trial)) throw InputError(cannot + "its folder takes no new file");
  fs::remove(trial, error);
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  const fs::path first = fs::weakly_canonical(a, ignored);
  return !first.empty() && first == fs::weakly_canonical(b, ignored);
}

void check_outputs(const std::string& shape, const DeformFlags& flags) {
  check_output(flags.out, "--out");
  check_output(flags.metrics, "--metrics");
  check_output(flags.picture, "--picture");
  check_extension(flags.out);
  if (!flags.picture.empty() && fs::path(flags.picture).extension() != ".png") {
    throw InputError("--picture '" + flags.picture + "': a picture's name must end in .png");
  }
  const std::vector<std::string> files{shape, flags.edit, flags.out, flags.metrics, flags.picture};
  for (std::size_t written = 2; written < files.size(); ++written) {
    for (std::size_t other = 0; other < written; ++other) {
      const bool in_place = written == 2 && other == 0;
      const bool same = same_file(files[written], files[other]);
      if (in_place || files[written].empty() || !same) continue;
      throw InputError("'" + files[written] + "' is named twice, by two of SHAPE, --edit, --out, " +
                       "--metrics and --picture; only SHAPE and --out may be one file");
    }
  }
}

/// What key=value may set.
struct DeformOptions {
  EmbeddedDeformationOptions deformation;
  PictureOptions picture;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    EmbeddedDeformationOptions::fields(o.deformation, visit);
    visit("picture", o.picture, "how --picture is drawn");
  }
};

DeformOptions read_options(const std::vector<std::string>& overrides, int nodes) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::kMap;
  apply_override(root, {"graph.nodes", std::to_string(nodes), "."});
  for (const std::string& text : overrides) apply_override(root, parse_override(text));
  auto options = read_config<DeformOptions>(root);
  complete_energies(root, options.deformation);
  return options;
}

Image draw(const EmbeddedDeformation& deformer, const Shape& rest, const ResolvedEdit& edit,
           const PictureOptions& options) {
  PictureBook pictures{options};
  pictures.add_rest(deformer, rest, edit);
  pictures.add_deformed(deformer, edit, "deformed");
  return pictures.render();
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
  check_outputs(arguments.front(), flags);
  const auto options = read_options({arguments.begin() + 1, arguments.end()}, flags.nodes);
  const std::vector<EditEntry> entries = read_edit_file(flags.edit);
  const Shape rest = read_shape(arguments.front());
  const ResolvedEdit edit = resolve(entries, rest);

  EmbeddedDeformation deformer(rest, options.deformation);
  deformer.compile(edit.handles);
  const Report report = deformer.update(edit.targets);
  for (const std::string& note : report.notes) LOG(WARNING) << note;
  if (report.solve.status == Status::kFailed) {
    std::fprintf(stderr, "deformlab: the solver failed: %s; nothing was written\n",
                 report.solve.message.c_str());
    return 1;
  }
  if (report.solve.status != Status::kConverged) LOG(WARNING) << report.solve.message;
  Image picture;  // drawn before the first file is written, as drawing may fail
  if (!flags.picture.empty()) picture = draw(deformer, rest, edit, options.picture);
  write_shape(flags.out, deformer.deformed(), arguments.front());  // first: it may be refused
  if (!flags.metrics.empty()) write_text(flags.metrics, to_json(report));
  if (!flags.picture.empty()) write_png(picture, flags.picture);
  print(report, flags.out);
  return 0;
}

}  // namespace deformlab
