#pragma once

#include "energies/graph/context.h"
#include "energies/graph/nodes.h"
#include "energies/term.h"

// Sums over a graph. `element` makes the data of one element; a term without data needs none.
namespace deformlab {

/// Σ over all nodes. element(j) makes the element of node j.
template <class Term, class Make>
Terms<Term> over_nodes(const GraphContext& context, Make element) {
  Terms<Term> sum;
  for (int j = 0; j < context.graph.g.cols(); ++j) sum.add(element(j), {j});
  return sum;
}
template <class Term>
Terms<Term> over_nodes(const GraphContext& context) {
  return over_nodes<Term>(context, [](int) { return Term{}; });
}

/// Σ over both directions of every edge, each weighted by α_jk and the edge's stiffness.
/// element(j, k) makes that of j → k.
template <class Term, class Make>
Terms<Term> over_edges(const GraphContext& context, Make element) {
  Terms<Term> sum;
  for (const auto& [j, k, alpha] : context.graph.edges) {
    const double weight = alpha * context.stiffness_of(j, k);
    sum.add(element(j, k), {j, k}, weight);
    sum.add(element(k, j), {k, j}, weight);
  }
  return sum;
}
template <class Term>
Terms<Term> over_edges(const GraphContext& context) {
  return over_edges<Term>(context, [](int, int) { return Term{}; });
}

/// Σ over all handles, each with its weight. Each reads the k nodes that influence it as one
/// NodeList. element(l) makes the element of handle l.
template <class Term, class Make>
Terms<Term> over_handles(const GraphContext& context, Make element) {
  const Embedding& handles = context.handles;
  Terms<Term> sum{.arity = static_cast<int>(handles.nodes.rows())};
  sum.reserve(handles.v.cols());
  for (int l = 0; l < handles.v.cols(); ++l) {
    const auto nodes = handles.nodes.col(l);
    sum.add(element(l), std::span(nodes.data(), nodes.size()), context.weight_of_handle(l));
  }
  return sum;
}

}  // namespace deformlab
