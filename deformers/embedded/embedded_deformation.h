#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "deformers/deformer.h"
#include "deformers/embedded/embedded_options.h"
#include "deformers/embedded/handles/pins.h"
#include "deformers/embedded/handles/satellites.h"
#include "geometry/graph/graph_build.h"
#include "geometry/transfer/transfer.h"
#include "solvers/solver.h"

namespace deformlab {

/// Embedded Deformation for Shape Manipulation (Sumner, Schmid, Pauly 2007).
class EmbeddedDeformation final : public Deformer {
 public:
  /// Builds the graph, in which parts that `cuts` separate do not influence each other. Nodes
  /// inside a closed shape (graph.interior) are added when handles are compiled. With graph.region
  /// "active" the graph depends on what is fixed: `compile` builds it then, and again whenever
  /// other vertices are fixed, and the transformations begin at rest. Throws InputError for options
  /// and cuts that are out of range or do not fit the shape.
  EmbeddedDeformation(Shape rest, const EmbeddedDeformationOptions& options,
                      std::span<const Cut> cuts = {});
  /// Builds the edges and weights for nodes that are given (3×m) [length].
  EmbeddedDeformation(Shape rest, const Eigen::Matrix3Xd& nodes,
                      const EmbeddedDeformationOptions& options, std::span<const Cut> cuts = {});
  /// Takes a graph whose nodes and edges are given [length].
  EmbeddedDeformation(Shape rest, DeformationGraph graph,
                      const EmbeddedDeformationOptions& options);

  void compile(const Handles& handles) override;
  Report update(const Eigen::Matrix3Xd& targets) override;
  const Shape& deformed() const override { return deformed_; }
  void reset() override;
  /// Gives the rest shape another pose: the same vertices at other positions, and the nodes (3×m)
  /// with them [length]. The graph's edges, all weights and the unit stay, the transformations
  /// begin at rest, and the handles have to be compiled again. Throws InputError for another number
  /// of vertices or nodes, for one that is not finite, and as `check` does.
  void repose(const Shape& rest, const Eigen::Matrix3Xd& nodes);

  /// Sets the transformations (3×4m), t_j [length], from which the next update starts. Fixed nodes
  /// stay at rest, and rigid nodes take the nearest rotations. Throws InputError for another number
  /// of transformations, and for one that is not finite.
  void begin_at(const Transformations& X);

  const DeformationGraph& graph() const { return graph_; }   ///< at rest [length]
  const Embedding& embedding() const { return embedding_; }  ///< of all vertices [length]
  /// The vertex at each node that is not inside, as in BuiltGraph.
  const std::vector<int>& node_vertices() const { return node_vertices_; }
  Transformations transformations() const;  ///< 3×4m, t_j [length]
  /// The positions (3×p) [length] to which X (3×4m) moves the handles that are points.
  Eigen::Matrix3Xd points(const Transformations& X) const;
  const Problem& problem() const { return problem_; }  ///< lengths are in units of length_unit()
  double length_unit() const { return unit_; }
  /// How many times the whole problem was compiled. Where few handles were added or removed,
  /// `compile` only adapts it, unless `reset` was called before.
  int compilations() const { return compilations_; }

 private:
  void register_graph(BuiltGraph built);
  void set_graph(DeformationGraph graph);
  void check_interior() const;
  bool wants_interior() const;
  bool fit_interior();
  void build_active_graph(const Handles& handles);
  Unknowns rest_states(int m) const;
  void fix_nodes(const std::vector<char>& fixed);
  void embed_handles(const Handles& handles);
  Embedding embedded_points(const Eigen::Matrix3Xd& points) const;
  void embed_satellites(const Handles& handles);
  Eigen::Matrix3Xd all_targets(const Eigen::Matrix3Xd& targets) const;
  Eigen::VectorXd node_stiffness() const;
  std::vector<char> nodes_at_rest() const;
  void pin_components();
  template <class Make>
  void with_context(Make&& make) const;
  void make_terms();
  bool change_handles(const std::vector<char>& fixed_before);
  void transfer(const Transformations& X);
  void translate_pinned(const Eigen::Matrix3Xd& targets);
  void begin(const Eigen::Matrix3Xd& targets);
  bool begin_harmonic(const Eigen::Matrix3Xd& targets);
  Eigen::Matrix3Xd start_rotations(const Eigen::Matrix3Xd& targets) const;
  void set_constraint_weight(double weight);
  void relax(const Eigen::Matrix3Xd& targets, Report& report);
  void measure(const Transformations& X, const Eigen::Matrix3Xd& targets, Report& report) const;
  Advice advice() const;
  void check_in_plane(const Eigen::Matrix3Xd& targets) const;
  void add_notes(Report& report) const;

  EmbeddedDeformationOptions options_;
  Shape rest_, deformed_;
  std::vector<Cut> cuts_;  // for the graph of the active part, which is built when it is known
  std::optional<std::vector<int>> built_for_;  // the fixed vertices that its graph is for
  std::vector<int> active_;                    // the vertices that follow the graph; empty: all
  Embedding embedding_;                        // of the whole shape [length]
  // The handles that the user moves, of which the last are points, then the fixed vertices that a
  // soft border holds, and then the satellites of handles that hold an angle [length].
  Embedding handles_;
  Eigen::Index moved_ = 0, points_ = 0;
  Eigen::Matrix3Xd rotations_;  // as in Handles
  std::vector<int> groups_;
  Satellites satellites_;
  Embedding satellite_places_, satellite_owners_;  // and their handles
  Eigen::VectorXd handle_weights_;                 // of all handles_, or empty
  std::vector<int> fixed_;                         // vertices
  int immovable_ = 0;
  bool at_rest_ = true;  // no solve has changed the transformations yet
  DeformationGraph graph_;
  DeformationGraph surface_graph_;  // without nodes inside, which are the last in graph_
  bool has_interior_ = false;
  std::vector<int> node_vertices_;
  bool in_space_ = true;  // a point can be embedded by its position alone
  double unit_ = 1;
  Problem problem_;
  std::vector<TermRecipe> recipes_;  // of the problem's terms
  std::vector<char> reads_handles_;  // whether each of them reads the handles
  int compilations_ = 0;
  bool compiled_ = false;  // the solver has compiled the problem on this graph
  std::vector<PointPin> at_one_point_;
  std::vector<std::vector<int>> on_one_line_;  // as in Pins
  std::unique_ptr<Solver> solver_;
  std::map<std::string, double> seconds_;
  std::vector<std::string> registration_notes_, compilation_notes_;
};

}  // namespace deformlab
