#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "energies/energy.h"
#include "energies/signature.h"

namespace deformlab {

/// The Energy of any term: residuals by its call operator, Jacobians by its `jacobian` or, without
/// one, by automatic differentiation, one argument after the other.
template <class Term>
class TermEnergy final : public Energy {
  template <class T>
  using Sig = Signature<decltype(&Term::template operator()<T>)>;
  using Residual = typename Sig<double>::Residual;
  static constexpr int kRows = Residual::RowsAtCompileTime;
  static constexpr int kDimension = Reads<typename Sig<double>::First>::kDimension;
  static constexpr int kMaxColumns =
      *std::max_element(Sig<double>::kColumns.begin(), Sig<double>::kColumns.end());
  using Jet = ceres::Jet<double, kDimension * kMaxColumns>;
  static_assert(kRows > 0,
                "a term returns a residual of fixed size, such as Vector<T, 3>, not auto");
  static_assert(kRows <= kMaxResiduals, "split a term of so many residuals into several");

 public:
  /// Whether the term brings its own derivative, which must be an ordinary member function.
  static constexpr bool kAnalytic = requires { &Term::jacobian; };

  explicit TermEnergy(Terms<Term> sum) : sum_(std::move(sum)) {
    if constexpr (!Sig<double>::kAnyNumber) sum_.arity = Sig<double>::kArity;
  }

  std::string_view name() const override { return Term::kName; }
  Structure structure() const override { return Term::kStructure; }
  int size() const override { return static_cast<int>(sum_.elements.size()); }
  int rows() const override { return kRows; }
  int dimension() const override { return kDimension; }
  int arity() const override { return sum_.arity; }
  Argument argument(int a) const override {
    return {Sig<double>::kColumns[Sig<double>::kAnyNumber ? 0 : a]};
  }
  std::span<const int> nodes(int e) const override {
    return std::span(sum_.nodes).subspan(std::size_t(e) * arity(), arity());
  }

  void evaluate(int e, const double* const* x, double* r, double* J) const override {
    const double scale = std::sqrt(sum_.weights[e]);
    Eigen::Map<Residual> value(r);
    value = scale * Sig<double>::apply(sum_.elements[e], x, arity());
    if (J == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, kRows, Eigen::Dynamic>> jacobian(J, kRows, jacobian_columns());
    if constexpr (kAnalytic) {
      const auto call = [&](const auto&... nodes) { return sum_.elements[e].jacobian(nodes...); };
      jacobian = Sig<double>::apply(call, x, arity());
    } else {
      jets(e, x, jacobian);
    }
    jacobian *= scale;
  }

  void residuals(const Unknowns& x, double* r) const override {
    for (int e = 0; e < size(); ++e, r += kRows) evaluate(e, pointers(x, e).data(), r, nullptr);
  }

  void jacobians(const Unknowns& x, double* J) const override {
    Residual r;
    const int stride = kRows * jacobian_columns();
    for (int e = 0; e < size(); ++e, J += stride) evaluate(e, pointers(x, e).data(), r.data(), J);
  }

  void aim(const Eigen::MatrixXd& targets) override {
    if constexpr (requires(Term t) { t.aim(targets); }) {
      for (Term& element : sum_.elements) element.aim(targets);
    }
  }

  /// The derivative of one element by automatic differentiation, without its weight.
  void jets(int e, const double* const* x,
            Eigen::Ref<Eigen::Matrix<double, kRows, Eigen::Dynamic>> J) const {
    std::array<std::array<Jet, kDimension * kMaxColumns>, Sig<double>::kArity> values;
    std::array<const Jet*, Sig<double>::kArity> at;
    for (int a = 0; a < arity(); ++a) {
      at[a] = values[a].data();
      for (int i = 0; i < entries(a); ++i) values[a][i] = Jet(x[a][i]);
    }
    for (int a = 0, column = 0; a < arity(); column += entries(a++)) {
      for (int i = 0; i < entries(a); ++i) values[a][i].v[i] = 1;
      const auto r = Sig<Jet>::apply(sum_.elements[e], at.data(), arity());
      for (int row = 0; row < kRows; ++row) {
        J.row(row).segment(column, entries(a)) = r[row].v.head(entries(a)).transpose();
      }
      for (int i = 0; i < entries(a); ++i) values[a][i].v[i] = 0;
    }
  }

 private:
  int entries(int a) const { return kDimension * argument(a).count; }

  std::array<const double*, Sig<double>::kArity> pointers(const Unknowns& x, int e) const {
    std::array<const double*, Sig<double>::kArity> result{};
    const int* node = sum_.nodes.data() + std::size_t(e) * arity();
    for (int a = 0; a < arity(); ++a) result[a] = x.node(node[a]);
    return result;
  }

  Terms<Term> sum_;
};

}  // namespace deformlab
