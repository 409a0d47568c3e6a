#include <fmt/format.h>
#include <gflags/gflags.h>

#include <string_view>

#include "energies/catalog.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/environment.h"
#include "experiments/config/config.h"
#include "experiments/subjects/experiment.h"
#include "experiments/subjects/motion/script.h"
#include "experiments/subjects/shape/edit.h"

DEFINE_bool(markdown, false, "help: print the page docs/keys.md");

namespace deformlab {
namespace {

constexpr std::string_view kUsage = R"(deformlab: shape deformation by nonlinear least squares

Commands

  deformlab run CONFIG... [key=value]... [--out DIR]
      Runs each config, checks its claims, and writes DIR/<name of the config>/ and the page
      DIR/README.md with all pictures. DIR is `results` by default.

  deformlab deform SHAPE --edit EDIT.yaml --out OUT [--nodes N] [key=value]...
                   [--metrics FILE.json] [--picture FILE.png]
      Deforms a shape: a mesh, a polygon soup or a point set (.off .obj .ply .stl .xyz).

  deformlab deform DRAWING --edit EDIT.yaml --out OUT [--vertices N] [key=value]...
                   [--metrics FILE.json] [--picture FILE.png]
      Deforms a drawing: an image (.png), a vector drawing (.svg), a polygon (.txt), or a flat mesh
      with deformer=arap_2d. Positions are [x, y] in pixels, and y points down.

  deformlab animate DRAWING --edit KEYS.yaml --out 'frame-%03d.png' | --out MOVIE.webp
                    [--vertices N] [key=value]... [--metrics FILE.json] [--picture FILE.png]
      Lets a drawing move. KEYS.yaml has `keyframes:` of its handles, or `poses:` and the CSV file of
      a `cursor:`, or `handles:` and the CSV file of their `performance:`. The keys fps, loop and
      interpolation have these short names here.

  deformlab animate --frames 'horse-%03d.obj' --edit EDIT.yaml --out 'edited-%03d.obj'
                    [--nodes N] [key=value]... [--metrics FILE.json] [--picture FILE.png]
      Edits an animation of a mesh, one file for each frame. EDIT.yaml may have `keyframes:` beside
      or instead of `edit:`. If a run was stopped, the same command continues it.

  deformlab animate --particles CACHE.csv --edit EDIT.yaml --out OUT.csv
                    [--nodes N] [key=value]... [--metrics FILE.json] [--picture FILE.png]
      Edits a table of particles with the columns frame,id,x,y,z. The graph's nodes lie on the path
      of one particle. The key `path` names this particle; by default the program chooses one.

  deformlab list               prints the energy terms and the options of embedded deformation
  deformlab help               prints this text, as --help does
  deformlab version            prints the version and the commit, as --version does
  deformlab help --markdown    prints the keys as the page docs/keys.md

`key=value` sets a key of the config. A dot leads to a nested key: solver.method=ceres. The value is
YAML. --minloglevel=0 prints more messages, and --minloglevel=2 prints errors only.

Exit status: 0 if the command succeeded and every claim holds or falls short for a reason that the
config gives under `known`; 1 if a claim falls short or a solve failed; 2 if an input cannot be used
(the message says what is wrong and how to mend it); 3 if `deform` wrote a result that is not what
the edit asked for: handles that miss their targets by more than 2 % of the motion, tears, parts that
are inside out, lost turns (with --strict it writes nothing then); 4 if the program itself failed.
)";

constexpr std::string_view kPage = R"(# All keys

The program prints this page: `./deformlab help --markdown >docs/keys.md` makes it again, and a test
compares the two. A key is set in a config file or on the command line: `graph.nodes=425`. In the
tables `list[].key` is a key of each entry of a list, and `map.NAME.key` is a key under each name of
a map. A key without a default is optional; "required" marks one that must be given.
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string row(const FieldHelp& field) {
  const std::string value = field.value.empty() || field.value == "required"
                                ? field.value
                                : fmt::format("`{}`", escaped(field.value));
  return fmt::format("| `{}` | {} | {} |\n", field.name, value, escaped(field.meaning));
}

// The first part of a key: `graph` of graph.nodes, `claims` of claims[].name.
std::string_view root(const FieldHelp& field) {
  return std::string_view(field.name).substr(0, field.name.find_first_of(".["));
}

// A table of the keys without parts, and then one for each key that has parts.
std::string tables(const std::vector<FieldHelp>& fields) {
  constexpr std::string_view kHead = "\n| key | default | meaning |\n|---|---|---|\n";
  std::string plain, nested, section;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (root(fields[i]) == section) {
      nested += row(fields[i]);
    } else if (i + 1 < fields.size() && root(fields[i]) == root(fields[i + 1])) {
      section = root(fields[i]);
      nested += fmt::format("\n### `{}`\n\n{}\n{}", section, fields[i].meaning, kHead);
    } else {
      plain += row(fields[i]);
    }
  }
  return (plain.empty() ? "" : std::string(kHead) + plain) + nested;
}

const char* name_of(Structure structure) {
  if (structure == Structure::kKronecker) return "Kronecker";
  return structure == Structure::kLinear ? "linear" : "nonlinear";
}

std::string energies_table() {
  std::string text = "\n| term | default weight | structure |\n|---|---|---|\n";
  for (const EnergyInfo& info : known_energies()) {
    text += fmt::format("| `{}` | {} | {} |\n", info.name,
                        to_yaml_line(to_node(info.default_weight)), name_of(info.structure));
  }
  return text;
}

std::string markdown() {
  return fmt::format(
      "{}\n## Keys of a config\n{}\n## Entries of `edit`\n{}\n"
      "## Keys beside `edit` in the file of an animation's edit\n{}\n## Energy terms\n{}",
      kPage, tables(describe<ExperimentConfig>()), tables(describe<EditEntry>()),
      tables(describe<KeyframesOptions>()), energies_table());
}

}  // namespace

std::string help_text() {
  if (FLAGS_markdown) return markdown();
  return fmt::format(
      "{}\nKeys of a config, with their defaults and meanings:\n\n{}\n"
      "Keys of each entry of `edit:`\n\n{}\n"
      "Keys beside `edit:` in the file of an animation's edit:\n\n{}",
      kUsage, to_text(describe<ExperimentConfig>()), to_text(describe<EditEntry>()),
      to_text(describe<KeyframesOptions>()));
}

std::string version_text() {
  const auto known = environment();
  return fmt::format("deformlab {} (commit {})\n", known.at("deformlab"), known.at("commit"));
}

std::string list_text() {
  std::string text = "Energy terms (name, default weight, structure):\n";
  for (const EnergyInfo& info : known_energies()) {
    text +=
        fmt::format("  {}  {}  {}{}\n", info.name, to_yaml_line(to_node(info.default_weight)),
                    name_of(info.structure), info.for_rigid_nodes ? "" : ", not for rigid nodes");
  }
  return text + "\nOptions of embedded deformation:\n" +
         to_text(describe<EmbeddedDeformationOptions>());
}

}  // namespace deformlab
