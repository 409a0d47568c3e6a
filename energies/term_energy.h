#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "energies/energy.h"
#include "energies/room.h"
#include "energies/term.h"

namespace deformlab {

/// The structure that a term declares.
template <class Term>
constexpr Structure structure_of() {
  if constexpr (requires { Term::kStructure; }) return Term::kStructure;
  return Structure::kNonlinear;
}

/// Checks at compile time whether a term can be used. Each check says in one line what is wrong.
template <class Term>
struct TermChecks {
  using Plain = SignatureOf<Term>;
  static constexpr int kRows = Plain::Residual::RowsAtCompileTime;
  static constexpr bool kNamed = requires { std::string_view(Term::kName); };
  static constexpr bool kTemplate = !std::is_void_v<typename CallOperator<Term, double>::Type>;
  static constexpr bool kConst = !std::is_void_v<typename Plain::Return>;

  static_assert(kNamed, "a term needs a name: static constexpr std::string_view kName = \"...\";");
  static_assert(kTemplate,
                "a term needs a call operator that is a template over the scalar alone: "
                "template <class T> Vector<T, n> operator()(...) const");
  static_assert(!kTemplate || kConst, "the call operator of a term has to be const");
  static_assert(!kConst || Plain::kReadable,
                "the call operator of a term takes Vector<T, d>, Matrix<T, d>, Affine<T, d> or "
                "State<Node, T> of one node for each argument, or one NodeList of these by value");
  static_assert(!kConst || !Plain::kReadable || Plain::kUsable,
                "the call operator of a term has to return Vector<T, n> with a fixed n; write that "
                "type, because auto returns an Eigen expression instead of its value");
  static_assert(kRows <= kMaxResiduals,
                "a term may have kMaxResiduals residuals; split it into several terms, or raise "
                "kMaxResiduals in energies/energy.h");
  static_assert(!Plain::kUsable || structure_of<Term>() != Structure::kKronecker ||
                    kRows == Plain::kDimension,
                "a Kronecker term has as many residuals as there are coordinates");
};

/// The Energy of any term. Its call operator computes residuals. Its `jacobian` computes Jacobians;
/// without one, automatic differentiation does, one argument after the other.
template <class Term>
class TermEnergy final : public Energy, private TermChecks<Term> {
  template <class T>
  using Sig = SignatureOf<Term, T>;
  using Plain = Sig<double>;
  using Residual = typename Plain::Residual;
  static constexpr bool kAnyNumber = Plain::kAnyNumber;
  static constexpr int kUsualArity = kAnyNumber ? 16 : Plain::kArity;
  static constexpr int kRows = Residual::RowsAtCompileTime;
  static constexpr int kDimension = Plain::kDimension;
  static constexpr int kMaxColumns =
      *std::max_element(Plain::kColumns.begin(), Plain::kColumns.end());
  static constexpr int kUsualWidth =
      kDimension * (kAnyNumber
                        ? kMaxColumns * kUsualArity
                        : std::accumulate(Plain::kColumns.begin(), Plain::kColumns.end(), 0));
  static constexpr int kWidth = kAnyNumber ? Eigen::Dynamic : kUsualWidth;
  static constexpr int kOrder = kRows == 1 ? Eigen::RowMajor : Eigen::ColMajor;
  /// J of an element with at most the usual number of nodes, and of one with any number.
  using Jacobian = Eigen::Matrix<double, kRows, kWidth, kOrder, kRows, kUsualWidth>;
  using WideJacobian = Eigen::Matrix<double, kRows, kWidth, kOrder>;
  using Jet = ceres::Jet<double, kDimension * kMaxColumns>;
  using Pointers = Room<const double*, kUsualArity>;
  static constexpr bool kUsable =
      Plain::kUsable && std::is_same_v<typename Sig<Jet>::Residual::Scalar, Jet>;
  static_assert(kUsable || !Plain::kUsable,
                "the call operator of a term has to return Vector<T, n> of the scalar T for every "
                "T, not of double alone");

 public:
  /// Whether the term has its own derivative, as an ordinary member function.
  static constexpr bool kCoefficients = kUsable && requires { &Term::coefficients; };
  static constexpr bool kAnalytic = kCoefficients || (kUsable && requires { &Term::jacobian; });

  explicit TermEnergy(Terms<Term> sum) : sum_(std::move(sum)) {
    for (double& weight : sum_.weights) weight = std::sqrt(weight);  // the factor of r and J
  }

  std::string_view name() const override { return name_of<Term>(); }
  Structure structure() const override { return structure_of<Term>(); }
  int size() const override { return static_cast<int>(sum_.elements.size()); }
  int rows() const override { return kRows; }
  int dimension() const override { return kDimension; }
  int arity() const override { return sum_.arity; }
  Argument argument(int a) const override { return {Plain::kColumns[kAnyNumber ? 0 : a]}; }
  using Energy::nodes;
  std::span<const int> nodes() const override { return sum_.nodes; }

  void evaluate(int e, const double* const* x, double* r, double* J) const override {
    const double scale = sum_.weights[e];
    Eigen::Map<Residual> value(r);
    value = scale * Plain::apply(sum_.elements[e], x, arity());
    if (J == nullptr) return;
    Eigen::Map<WideJacobian> jacobian(J, kRows, jacobian_columns());
    if constexpr (kCoefficients) {
      const auto a = sum_.elements[e].coefficients(arity());
      jacobian.setZero();
      for (Eigen::Index p = 0; p < jacobian.size() / kRows; ++p) {
        jacobian(p % kDimension, p) = a.data()[p / kDimension];
      }
    } else if constexpr (kAnalytic) {
      const auto call = [&](const auto&... nodes) { return sum_.elements[e].jacobian(nodes...); };
      jacobian = Plain::apply(call, x, arity());
    } else {
      jets(e, x, jacobian);
    }
    jacobian *= scale;
  }

  void residuals(const Unknowns& x, double* r) const override {
    Pointers at(arity());
    for (int e = 0; e < size(); ++e, r += kRows) evaluate(e, point(x, e, at), r, nullptr);
  }

  void jacobians(const Unknowns& x, double* J) const override {
    Residual r;
    Pointers at(arity());
    const int stride = kRows * jacobian_columns();
    for (int e = 0; e < size(); ++e, J += stride) evaluate(e, point(x, e, at), r.data(), J);
  }

  void coefficients(double* a) const override {
    const int count = jacobian_columns() / kDimension;
    if constexpr (kCoefficients) {
      for (int e = 0; e < size(); ++e, a += count) {
        const auto own = sum_.elements[e].coefficients(arity());
        for (int c = 0; c < count; ++c) a[c] = sum_.weights[e] * own.data()[c];
      }
    } else {  // reads the first row of J, which is the same at any x
      Pointers zero(arity());
      point_to_zero(zero);
      Eigen::Matrix<double, kRows, Eigen::Dynamic> J(kRows, jacobian_columns());
      Residual r;
      for (int e = 0; e < size(); ++e, a += count) {
        evaluate(e, zero.data(), r.data(), J.data());
        for (int c = 0; c < count; ++c) a[c] = J(0, c * kDimension);
      }
    }
  }

  void offsets(double* b) const override {  // b is −r for X = 0
    Pointers zero(arity());
    point_to_zero(zero);
    for (int e = 0; e < size(); ++e, b += kRows) {
      Eigen::Map<Residual> own(b);
      if constexpr (kUsable && requires { &Term::offset; }) {
        own = sum_.weights[e] * sum_.elements[e].offset(arity());
      } else {
        own = -sum_.weights[e] * Plain::apply(sum_.elements[e], zero.data(), arity());
      }
    }
  }

  void normal_equations(const Unknowns& x, double* JtJ, double* Jtr) const override {
    with_jacobian([&](auto& J) {
      Residual r;
      Pointers at(arity());
      const int n = jacobian_columns();
      for (int e = 0; e < size(); ++e, JtJ += std::ptrdiff_t(n) * n, Jtr += n) {
        evaluate(e, point(x, e, at), r.data(), J.data());
        Eigen::Map<Eigen::Matrix<double, kWidth, kWidth>>(JtJ, n, n).noalias() =
            J.transpose().lazyProduct(J);
        Eigen::Map<Eigen::Matrix<double, kWidth, 1>>(Jtr, n).noalias() = J.transpose() * r;
      }
    });
  }

  void transposed_products(const Unknowns& x, const double* r, double* Jtr) const override {
    with_jacobian([&](auto& J) {
      Residual own;
      Pointers at(arity());
      const int n = jacobian_columns();
      for (int e = 0; e < size(); ++e, r += kRows, Jtr += n) {
        evaluate(e, point(x, e, at), own.data(), J.data());
        Eigen::Map<Eigen::Matrix<double, kWidth, 1>>(Jtr, n).noalias() =
            J.transpose() * Eigen::Map<const Residual>(r);
      }
    });
  }

  void set_targets(const Eigen::MatrixXd& targets) override {
    if constexpr (requires(Term t) { t.set_targets(targets); }) {
      for (Term& element : sum_.elements) element.set_targets(targets);
    }
  }

  /// The derivative of one element by automatic differentiation, without its weight.
  void jets(int e, const double* const* x,
            Eigen::Ref<Eigen::Matrix<double, kRows, Eigen::Dynamic>> J) const {
    for (int a = 0, column = 0; a < arity(); column += entries(a++)) {
      if constexpr (kUsable) {
        const auto r = Sig<Jet>::apply(sum_.elements[e], x, arity(), a);
        for (int row = 0; row < kRows; ++row) {
          for (int i = 0; i < entries(a); ++i) J(row, column + i) = r[row].v[i];
        }
      }
    }
  }

 private:
  int entries(int a) const { return kDimension * argument(a).count; }

  const double* const* point(const Unknowns& x, int e, Pointers& at) const {
    const int* node = sum_.nodes.data() + std::size_t(e) * arity();
    for (int a = 0; a < arity(); ++a) at.data()[a] = x.node(node[a]);
    return at.data();
  }

  void point_to_zero(Pointers& at) const {
    static constexpr std::array<double, kDimension * kMaxColumns> kZero{};
    std::fill_n(at.data(), arity(), kZero.data());
  }

  /// Calls `use` with a matrix for the Jacobian of one element, which is on the stack unless the
  /// elements read very many nodes.
  template <class Use>
  void with_jacobian(Use use) const {
    if (!kAnyNumber || arity() <= kUsualArity) {
      Jacobian J(kRows, jacobian_columns());
      use(J);
    } else {
      WideJacobian J(kRows, jacobian_columns());
      use(J);
    }
  }

  Terms<Term> sum_;
};

/// The Energy of a sum, as a problem takes it: problem.terms.push_back({to_energy(sum), weight}).
template <class Term>
std::unique_ptr<Energy> to_energy(Terms<Term> sum) {
  return std::make_unique<TermEnergy<Term>>(std::move(sum));
}

}  // namespace deformlab
