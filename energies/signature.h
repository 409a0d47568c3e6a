#pragma once

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>
#include <utility>

#include "energies/term.h"

namespace deformlab {

/// What an argument type of a term reads of its node: a d×c matrix the node's first c columns.
template <class A>
struct Reads;
template <class T, int d, int c>
struct Reads<Eigen::Matrix<T, d, c>> {
  static constexpr int kDimension = d, kColumns = c;
  static Eigen::Matrix<T, d, c> from(const T* x) {
    return Eigen::Map<const Eigen::Matrix<T, d, c>>(x);
  }
};
template <class T, int d>
struct Reads<Affine<T, d>> {
  static constexpr int kDimension = d, kColumns = d + 1;
  static Affine<T, d> from(const T* x) {
    return {Reads<Matrix<T, d>>::from(x), Reads<Vector<T, d>>::from(x + d * d)};
  }
};

/// Arguments and residual of a term's call operator, read off its signature.
template <class Operator>
struct Signature;
template <class R, class Term, class... A>
struct Signature<R (Term::*)(A...) const> {
  using Residual = R;
  using First = std::remove_cvref_t<std::tuple_element_t<0, std::tuple<A...>>>;
  static constexpr bool kAnyNumber = false;
  static constexpr int kArity = sizeof...(A);
  static constexpr std::array<int, sizeof...(A)> kColumns{
      Reads<std::remove_cvref_t<A>>::kColumns...};

  template <class Call>
  static auto apply(Call&& call, const auto* const* x, int) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      return call(Reads<std::remove_cvref_t<A>>::from(x[i])...);
    }
    (std::index_sequence_for<A...>{});
  }
};
template <class R, class Term, class A>
struct Signature<R (Term::*)(std::span<const A>) const> {
  using Residual = R;
  using First = A;
  static constexpr bool kAnyNumber = true;
  static constexpr int kArity = kMaxNeighbors;
  static constexpr std::array<int, 1> kColumns{Reads<A>::kColumns};

  template <class Call>
  static auto apply(Call&& call, const auto* const* x, int arity) {
    std::array<A, kArity> nodes;
    for (int a = 0; a < arity; ++a) nodes[a] = Reads<A>::from(x[a]);
    return call(std::span<const A>(nodes.data(), arity));
  }
};

}  // namespace deformlab
