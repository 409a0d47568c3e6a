#include "energies/catalog.h"
#include "experiments/commands/commands.h"
#include "experiments/config/config.h"
#include "experiments/subjects/animation/script.h"
#include "experiments/subjects/experiment.h"
#include "experiments/subjects/shape/edit.h"

namespace deformlab {

std::string help_text() {
  return R"(deformlab: shape deformation by nonlinear least squares

  deformlab run CONFIG… [key=value]… [--out DIR]
      runs experiments, checks their claims, writes DIR/<config>/ (DIR: results)
  deformlab deform SHAPE --edit EDIT.yaml --out OUT [--nodes N] [key=value]…
                   [--metrics FILE.json] [--picture FILE.png]
      deforms a shape of your own (.off .obj .ply .stl .xyz)
  deformlab deform DRAWING --edit EDIT.yaml --out OUT [--vertices N] [key=value]…
      deforms a drawing (.png .svg, a polygon .txt), or a flat mesh with deformer=arap_2d;
      places are [x, y] in pixels, y down
  deformlab animate --frames 'horse-%03d.obj' --edit EDIT.yaml --out 'edited-%03d.obj'
                    [--nodes N] [key=value]… [--metrics FILE.json] [--picture FILE.png]
      edits a mesh animation; in EDIT.yaml `keyframes:` may stand beside or for `edit:`; a run that
      was stopped goes on where it was
  deformlab animate --particles CACHE.csv --edit EDIT.yaml --out OUT.csv [--nodes N] [key=value]…
      edits particles (frame,id,x,y,z); selections speak of the nodes along the path of one of
      them, chosen for its long and straight life, or by path=ID; --metrics and --picture as above
  deformlab list     the energies, solvers and their options
  deformlab help     this text, and every key of a config

Flags of the log: --minloglevel=0 tells more, --minloglevel=2 less.

Keys of a config, their defaults and meanings; key=value sets one from the command line:
)" + to_text(describe<ExperimentConfig>()) +
         "\nEntries of `edit:`, in a config or in EDIT.yaml:\n" + to_text(describe<EditEntry>()) +
         "\nBeside `edit:` in the EDIT.yaml of an animation:\n" +
         to_text(describe<KeyframesOptions>());
}

std::string list_text() {
  const auto structure = [](Structure s) {
    return s == Structure::kKronecker ? "Kronecker"
           : s == Structure::kLinear  ? "linear"
                                      : "nonlinear";
  };
  std::string text = "Energies (name, default weight, structure):\n";
  for (const EnergyInfo& info : known_energies()) {
    text += "  " + info.name + "  " + to_yaml_line(to_node(info.default_weight)) + "  " +
            structure(info.structure) + "\n";
  }
  return text + "\nDeformation:\n" + to_text(describe<EmbeddedDeformationOptions>());
}

}  // namespace deformlab
