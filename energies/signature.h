#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>

namespace deformlab {

template <class T, int n>
using Vector = Eigen::Matrix<T, n, 1>;
template <class T, int d>
using Matrix = Eigen::Matrix<T, d, d>;

/// How an argument of a term is read from its node: `kDimension` is d, and `kColumns` is how many
/// of the node's first columns it reads. `from(x, active)` makes the argument from the stored
/// entries x. If the scalar is a ceres::Jet and `active` is true, entry i is variable i.
///
/// A new type of argument needs a specialization of this template.
template <class A>
struct Reads;

template <class T, int d, int c>
struct Reads<Eigen::Matrix<T, d, c>> {
  static constexpr int kDimension = d, kColumns = c;

  /// `first` is the number of the first entry among those of the node.
  static Eigen::Matrix<T, d, c> from(const double* x, bool active, int first = 0) {
    if constexpr (std::is_same_v<T, double>) {
      return Eigen::Map<const Eigen::Matrix<T, d, c>>(x + first);
    } else {
      Eigen::Matrix<T, d, c> result;
      for (int i = 0; i < d * c; ++i) {
        result.data()[i] = active ? T(x[first + i], first + i) : T(x[first + i]);
      }
      return result;
    }
  }
};

/// The argument of a term whose elements read any number of nodes. It is the same for all elements.
template <class A>
class NodeList {
 public:
  NodeList(const double* const* x, int size, int active) : x_(x), size_(size), active_(active) {}
  int size() const { return size_; }
  A operator[](int j) const { return Reads<A>::from(x_[j], j == active_); }

 private:
  const double* const* x_;
  int size_, active_;  // the entries of node `active_` are the variables of a Jet
};

template <class A>
concept Readable = requires {
  Reads<A>::kDimension;
};

/// A column vector of fixed size that stores its numbers; an Eigen expression does not.
template <class R>
concept FixedVector =
    std::derived_from<R, Eigen::PlainObjectBase<R>> && R::ColsAtCompileTime == 1 &&
    R::RowsAtCompileTime > 0;

/// The type of a term's call operator for the scalar T, or void if the term has none.
template <class Term, class T>
struct CallOperator {
  using Type = void;
};
template <class Term, class T>
requires requires { &Term::template operator()<T>; }
struct CallOperator<Term, T> {
  using Type = decltype(&Term::template operator()<T>);
};

/// What a call operator takes and returns. This general case describes an operator that cannot be
/// used. It compiles, so that the compiler prints no other error than the static_assert about it.
template <class Operator>
struct Signature {
  using Residual = Vector<double, 1>;
  using Return = void;
  static constexpr bool kUsable = false, kReadable = false, kAnyNumber = false;
  static constexpr int kArity = 1, kDimension = 1;
  static constexpr std::array<int, 1> kColumns{1};

  template <class Call>
  static Residual apply(Call&&, const double* const*, int, int = -1) {
    return Residual::Zero();
  }
};

/// The same for an operator whose type of result or of arguments a term cannot have.
template <class R, bool readable>
struct RefusedSignature : Signature<void> {
  using Return = R;
  static constexpr bool kReadable = readable;
};

template <class... A>
inline constexpr bool kAllReadable = sizeof...(A) > 0 && (Readable<std::remove_cvref_t<A>> && ...);

template <class R, class Term, class... A>
struct Signature<R (Term::*)(A...) const> : RefusedSignature<R, kAllReadable<A...>> {};

template <class R, class Term, class A>
requires(!FixedVector<R>) struct Signature<R (Term::*)(NodeList<A>) const>
    : RefusedSignature<R, Readable<A>> {
};

template <FixedVector R, class Term, class... A>
requires kAllReadable<A...>
struct Signature<R (Term::*)(A...) const> {
  using Residual = R;
  using Return = R;
  using First = std::remove_cvref_t<std::tuple_element_t<0, std::tuple<A...>>>;
  static constexpr bool kUsable = true, kReadable = true, kAnyNumber = false;
  static constexpr int kArity = sizeof...(A), kDimension = Reads<First>::kDimension;
  static constexpr std::array<int, sizeof...(A)> kColumns{
      Reads<std::remove_cvref_t<A>>::kColumns...};

  /// Calls a member of a term for one element, whose a-th node is stored at x[a].
  template <class Call>
  static auto apply(Call&& call, const double* const* x, int, int active = -1) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      return call(Reads<std::remove_cvref_t<A>>::from(x[i], static_cast<int>(i) == active)...);
    }
    (std::index_sequence_for<A...>{});
  }
};

template <FixedVector R, class Term, Readable A>
struct Signature<R (Term::*)(NodeList<A>) const> {
  using Residual = R;
  using Return = R;
  static constexpr bool kUsable = true, kReadable = true, kAnyNumber = true;
  static constexpr int kArity = 0, kDimension = Reads<A>::kDimension;
  static constexpr std::array<int, 1> kColumns{Reads<A>::kColumns};

  template <class Call>
  static auto apply(Call&& call, const double* const* x, int arity, int active = -1) {
    return call(NodeList<A>(x, arity, active));
  }
};

template <class Term, class T = double>
using SignatureOf = Signature<typename CallOperator<Term, T>::Type>;

}  // namespace deformlab
