#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace deformlab {

/// `deformlab run CONFIG… [key=value]… [--out DIR]`: runs each config, prints its claims, writes
/// DIR/<config>/ and rewrites DIR/README.md. Returns 1 where a claim falls short, else 0.
int run_command(const std::vector<std::string>& arguments, const std::filesystem::path& out);

/// What `deformlab deform` is told by flags.
struct DeformFlags {
  std::string edit, out, metrics, picture;
  int nodes = 0;     ///< graph.nodes, unless a key=value sets it
  int vertices = 0;  ///< of a drawing: drawing.vertices, unless a key=value sets it
};

/// `deformlab deform SHAPE --edit EDIT.yaml --out OUT [--nodes N] [key=value]… [--metrics
/// FILE.json]
/// [--picture FILE.png]`. Returns 1 where the solver could not take a step, with nothing written.
int deform_command(const std::vector<std::string>& arguments, const DeformFlags& flags);

/// Whether what `deform` is given is a drawing: by its extension, or because deformer=arap_2d.
bool is_drawing(const std::vector<std::string>& arguments);

/// `deformlab deform` for a drawing, with --vertices N for its mesh.
int deform_drawing(const std::vector<std::string>& arguments, const DeformFlags& flags);

/// What `deformlab help` and `deformlab list` print.
std::string help_text();
std::string list_text();

}  // namespace deformlab
