#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

#include "energies/unknowns.h"

namespace deformlab {

/// What a solver may rely on. Tests hold every registered term to what it declares.
enum class Structure {
  kKronecker,  ///< r = X a − b with one set of coefficients a for all d coordinates: JᵀJ = A ⊗ I_d
  kLinear,     ///< r = J x − b, J constant
  kNonlinear,  ///< any r, linearized in each Gauss–Newton step
};

/// The most residuals that one element may have.
inline constexpr int kMaxResiduals = 16;

/// The columns of its node that an argument of a term reads: `count` of them, from the first.
struct Argument {
  int count;
};

/// E(X) = Σ_e ‖r_e(X)‖², the sum of one term over its elements. Every element has the same number
/// of residuals and of arguments. The global weight w of a term is the solver's: it never enters.
///
/// Jacobians are rows() × jacobian_columns(), the arguments side by side, each with its d·count
/// entries in the order in which the node's columns are stored.
class Energy {
 public:
  virtual ~Energy() = default;

  virtual std::string_view name() const = 0;
  virtual Structure structure() const = 0;
  virtual int size() const = 0;       ///< number of elements
  virtual int rows() const = 0;       ///< residuals of one element
  virtual int dimension() const = 0;  ///< d
  virtual int arity() const = 0;      ///< arguments of one element
  virtual Argument argument(int a) const = 0;
  virtual std::span<const int> nodes() const = 0;  ///< arity() node indices an element, in turn
  std::span<const int> nodes(int e) const {
    return nodes().subspan(std::size_t(e) * arity(), arity());
  }

  /// One element: `x[a]` points to the first entry of its a-th node. J may be null.
  virtual void evaluate(int e, const double* const* x, double* r, double* J) const = 0;
  /// The residuals of all elements, rows() × size().
  virtual void residuals(const Unknowns& x, double* r) const = 0;
  /// The Jacobians of all elements side by side, rows() × (jacobian_columns() · size()).
  virtual void jacobians(const Unknowns& x, double* J) const = 0;
  /// Of a Kronecker term: a of every element, one column each, jacobian_columns() / d × size().
  virtual void coefficients(double* a) const = 0;
  /// And b, d × size(), which is another after `set_targets`.
  virtual void offsets(double* b) const = 0;
  /// What every element adds to the normal equations: JᵀJ, side by side, each square of
  /// jacobian_columns(), and Jᵀr, jacobian_columns() × size().
  virtual void normal_equations(const Unknowns& x, double* JtJ, double* Jtr) const = 0;
  /// Jᵀ at x times other residuals r, rows() × size(), of every element.
  virtual void transposed_products(const Unknowns& x, const double* r, double* Jtr) const = 0;

  /// What the term is drawn towards has moved: d×p targets, for the terms that have any (the
  /// handles' q_l of Eq. 8).
  virtual void set_targets(const Eigen::MatrixXd& targets) = 0;

  int jacobian_columns() const {
    int columns = 0;
    for (int a = 0; a < arity(); ++a) columns += dimension() * argument(a).count;
    return columns;
  }
};

}  // namespace deformlab
