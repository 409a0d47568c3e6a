#pragma once

#include <memory>
#include <span>
#include <string>

#include "deformers/arap_2d/arap_2d.h"
#include "deformers/baselines/cgal_arap.h"
#include "deformers/baselines/primo_deformation.h"
#include "deformers/baselines/rbf_deformation.h"
#include "deformers/embedded/adaptive_deformation.h"
#include "deformers/embedded/embedded_deformation.h"
#include "experiments/subjects/drawing/drawing_scene.h"

namespace deformlab {

/// The method that a config runs, and what each can be told. Embedded deformation's options stand
/// at the top of a config, those of the others under their names.
struct MethodOptions {
  std::string deformer = "auto";
  EmbeddedDeformationOptions deformation;
  Arap2dOptions arap_2d;
  RbfOptions rbf;
  PrimoOptions primo;
  CgalArapOptions arap;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.choice("deformer", o.deformer,
                 {"auto", "embedded_deformation", "arap_2d", "rbf", "primo", "cgal_arap"},
                 "the method; auto: embedded_deformation of a shape, arap_2d of a drawing");
    EmbeddedDeformationOptions::fields(o.deformation, visit);
    visit("arap_2d", o.arap_2d, "options of the method for drawings");
    visit("rbf", o.rbf, "options of radial basis functions");
    visit("primo", o.primo, "options of PriMo");
    visit("cgal_arap", o.arap, "options of CGAL's as-rigid-as-possible deformation");
  }
};

/// The method for a shape; `cuts` are for embedded deformation. Throws InputError where it is one
/// for drawings, or the method cannot take the shape or cuts.
std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const Shape& rest,
                                        std::span<const Cut> cuts = {});

/// The method for a drawing: arap_2d, or embedded deformation in the plane. Throws InputError
/// for one that is for shapes in space.
std::unique_ptr<Deformer> make_deformer(const MethodOptions& options, const DrawingScene& scene);

}  // namespace deformlab
