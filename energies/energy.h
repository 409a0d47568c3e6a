#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

#include "energies/unknowns.h"

namespace deformlab {

/// The structure of a term, which solvers rely on and check (energies/structure.h).
enum class Structure {
  kKronecker,  ///< r = X a − b with the same coefficients a for all d coordinates: JᵀJ = A ⊗ I_d
  kLinear,     ///< r = J x − b, J constant
  kNonlinear,  ///< any r, linearized in each Gauss–Newton step
};

/// The greatest number of residuals that one element may have.
inline constexpr int kMaxResiduals = 16;

/// An argument of a term reads the first `count` columns of its node.
struct Argument {
  int count;
};

/// E(X) = Σ_e ‖r_e(X)‖², the sum of one term over its elements. Every element has the same number
/// of residuals and of arguments. The weight w of the whole term belongs to the solver and is not
/// part of E.
///
/// A Jacobian is rows() × jacobian_columns(). The arguments stand side by side, each with its
/// d·count entries in the order in which the columns of the node are stored.
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
  virtual std::span<const int> nodes() const = 0;  ///< arity() node indices for each element
  std::span<const int> nodes(int e) const {
    return nodes().subspan(std::size_t(e) * arity(), arity());
  }

  /// Evaluates element e, whose a-th node begins at x[a]. J may be null.
  virtual void evaluate(int e, const double* const* x, double* r, double* J) const = 0;
  /// The residuals of all elements, rows() × size().
  virtual void residuals(const Unknowns& x, double* r) const = 0;
  /// The Jacobians of all elements side by side, rows() × (jacobian_columns() · size()).
  virtual void jacobians(const Unknowns& x, double* J) const = 0;
  /// For a Kronecker term: a of every element, one column each, jacobian_columns() / d × size().
  virtual void coefficients(double* a) const = 0;
  /// For a Kronecker term: b of every element, d × size(). It changes with `set_targets`.
  virtual void offsets(double* b) const = 0;
  /// What each element adds to the normal equations: JᵀJ, a square matrix of jacobian_columns() for
  /// each element, side by side, and Jᵀr, jacobian_columns() × size().
  virtual void normal_equations(const Unknowns& x, double* JtJ, double* Jtr) const = 0;
  /// The product of Jᵀ at x and given residuals r, rows() × size(), for each element.
  virtual void transposed_products(const Unknowns& x, const double* r, double* Jtr) const = 0;

  /// Sets the targets, d×p, of a term that has any, such as the q_l of Eq. 8.
  virtual void set_targets(const Eigen::MatrixXd& targets) = 0;

  int jacobian_columns() const {
    int columns = 0;
    for (int a = 0; a < arity(); ++a) columns += dimension() * argument(a).count;
    return columns;
  }
};

}  // namespace deformlab
