#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "deformers/arap_2d/arap_2d.h"
#include "deformers/baselines/cgal_arap.h"
#include "deformers/baselines/primo_deformation.h"
#include "deformers/baselines/rbf_deformation.h"
#include "deformers/embedded/adaptive_deformation.h"
#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/presets.h"
#include "experiments/subjects/deformer_kind.h"
#include "experiments/subjects/drawing/drawing_scene.h"

namespace deformlab {

/// The method that a config runs, and the options of each method. Those of embedded deformation
/// stand at the top of a config, those of the others under the method's name.
struct MethodOptions {
  DeformerKind deformer = DeformerKind::kAuto;
  /// A config names it, and its other keys change single options.
  Preset preset = Preset::kDefault;
  EmbeddedDeformationOptions deformation = preset_options();
  AdaptiveOptions adaptive;
  Arap2dOptions arap_2d;
  RbfOptions rbf;
  PrimoOptions primo;
  CgalArapOptions cgal_arap;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit("deformer", o.deformer,
          "The method that deforms; auto takes embedded_deformation for a shape and arap_2d for a "
          "drawing");
    visit("preset", o.preset,
          "The options of embedded deformation from which the other keys differ: those that suit "
          "most shapes and edits, or those of Sumner et al. 2007");
    EmbeddedDeformationOptions::fields(o.deformation, visit);
    visit(
        "adaptive", o.adaptive,
        "A graph of embedded deformation that begins with few nodes and grows where an edit needs "
        "them");
    visit("arap_2d", o.arap_2d,
          "Options of as-rigid-as-possible manipulation of drawings (Igarashi et al. 2005)");
    visit("rbf", o.rbf, "Options of deformation by radial basis functions");
    visit("primo", o.primo, "Options of PriMo");
    visit("cgal_arap", o.cgal_arap, "Options of CGAL's as-rigid-as-possible deformation");
  }
};

/// The method that reads a key of the first level of MethodOptions, other than `deformer`: the one
/// of this name, and otherwise embedded deformation.
DeformerKind method_that_reads(std::string_view key);
/// Whether the key is one of MethodOptions and another method reads it.
bool is_without_effect(std::string_view key, DeformerKind method);

/// The method for a shape. `cuts` are for embedded deformation. Throws InputError for a method that
/// is for drawings, or that cannot take the shape or the cuts.
std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const Shape& rest,
                                        std::span<const Cut> cuts = {});

/// The method for a drawing, which is arap_2d or embedded deformation in the plane. Throws
/// InputError for a method that is for shapes in space.
std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const DrawingScene& scene);

}  // namespace deformlab
