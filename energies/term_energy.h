#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
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
  static constexpr int kMostWidth =
      kDimension * (Sig<double>::kAnyNumber ? kMaxColumns * Sig<double>::kArity
                                            : std::accumulate(Sig<double>::kColumns.begin(),
                                                              Sig<double>::kColumns.end(), 0));
  static constexpr int kWidth = Sig<double>::kAnyNumber ? Eigen::Dynamic : kMostWidth;
  using Jacobian = Eigen::Matrix<double, kRows, kWidth,
                                 kRows == 1 ? Eigen::RowMajor : Eigen::ColMajor, kRows, kMostWidth>;
  using Jet = ceres::Jet<double, kDimension * kMaxColumns>;
  static_assert(kRows > 0,
                "a term returns a residual of fixed size, such as Vector<T, 3>, not auto");
  static_assert(kRows <= kMaxResiduals, "split a term of so many residuals into several");

 public:
  /// Whether the term brings its own derivative, by an ordinary member function.
  static constexpr bool kCoefficients = requires { &Term::coefficients; };
  static constexpr bool kAnalytic = kCoefficients || requires { &Term::jacobian; };

  explicit TermEnergy(Terms<Term> sum) : sum_(std::move(sum)) {
    if constexpr (!Sig<double>::kAnyNumber) sum_.arity = Sig<double>::kArity;
    for (double& weight : sum_.weights) weight = std::sqrt(weight);  // what r and J take of it
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
  using Energy::nodes;
  std::span<const int> nodes() const override { return sum_.nodes; }

  void evaluate(int e, const double* const* x, double* r, double* J) const override {
    const double scale = sum_.weights[e];
    Eigen::Map<Residual> value(r);
    value = scale * Sig<double>::apply(sum_.elements[e], x, arity());
    if (J == nullptr) return;
    Eigen::Map<Jacobian> jacobian(J, kRows, jacobian_columns());
    if constexpr (kCoefficients) {
      const auto a = sum_.elements[e].coefficients(arity());
      jacobian.setZero();
      for (Eigen::Index p = 0; p < jacobian.size() / kRows; ++p) {
        jacobian(p % kDimension, p) = a.data()[p / kDimension];
      }
    } else if constexpr (kAnalytic) {
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

  void coefficients(double* a) const override {
    const int count = jacobian_columns() / kDimension;
    if constexpr (kCoefficients) {
      for (int e = 0; e < size(); ++e, a += count) {
        const auto own = sum_.elements[e].coefficients(arity());
        for (int c = 0; c < count; ++c) a[c] = sum_.weights[e] * own.data()[c];
      }
    } else {  // the first row of J, at any x
      const std::array<double, kDimension * kMaxColumns> zero{};
      std::array<const double*, Sig<double>::kArity> x;
      x.fill(zero.data());
      Eigen::Matrix<double, kRows, Eigen::Dynamic> J(kRows, jacobian_columns());
      Residual r;
      for (int e = 0; e < size(); ++e, a += count) {
        evaluate(e, x.data(), r.data(), J.data());
        for (int c = 0; c < count; ++c) a[c] = J(0, c * kDimension);
      }
    }
  }

  void offsets(double* b) const override {  // −r where all is zero
    const std::array<double, kDimension * kMaxColumns> zero{};
    std::array<const double*, Sig<double>::kArity> x;
    x.fill(zero.data());
    for (int e = 0; e < size(); ++e, b += kRows) {
      Eigen::Map<Residual> own(b);
      if constexpr (requires { &Term::offset; }) {
        own = sum_.weights[e] * sum_.elements[e].offset(arity());
      } else {
        own = -sum_.weights[e] * Sig<double>::apply(sum_.elements[e], x.data(), arity());
      }
    }
  }

  void normal_equations(const Unknowns& x, double* JtJ, double* Jtr) const override {
    Jacobian J(kRows, jacobian_columns());
    Residual r;
    const int n = jacobian_columns();
    for (int e = 0; e < size(); ++e, JtJ += n * n, Jtr += n) {
      evaluate(e, pointers(x, e).data(), r.data(), J.data());
      Eigen::Map<Eigen::Matrix<double, kWidth, kWidth>>(JtJ, n, n).noalias() =
          J.transpose().lazyProduct(J);
      Eigen::Map<Eigen::Matrix<double, kWidth, 1>>(Jtr, n).noalias() = J.transpose() * r;
    }
  }

  void transposed_products(const Unknowns& x, const double* r, double* Jtr) const override {
    Jacobian J(kRows, jacobian_columns());
    Residual own;
    const int n = jacobian_columns();
    for (int e = 0; e < size(); ++e, r += kRows, Jtr += n) {
      evaluate(e, pointers(x, e).data(), own.data(), J.data());
      Eigen::Map<Eigen::Matrix<double, kWidth, 1>>(Jtr, n).noalias() =
          J.transpose() * Eigen::Map<const Residual>(r);
    }
  }

  void set_targets(const Eigen::MatrixXd& targets) override {
    if constexpr (requires(Term t) { t.set_targets(targets); }) {
      for (Term& element : sum_.elements) element.set_targets(targets);
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
        for (int i = 0; i < entries(a); ++i) J(row, column + i) = r[row].v[i];
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
