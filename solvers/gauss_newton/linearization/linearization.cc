#include "solvers/gauss_newton/linearization/linearization.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/core/error.h"
#include "solvers/gauss_newton/linearization/column_order.h"
#include "solvers/gauss_newton/linearization/node_blocks.h"

namespace deformlab {
namespace {

constexpr int kMostCoordinates = 4;  // of a column block

// If F has decreased to this share of the value that was last computed from all residuals, its
// rounding errors are no longer small, so it is computed again.
constexpr double kRefresh = 1e-8;

template <class Part>
std::vector<const Energy*> energies_of(const std::vector<Part>& parts) {
  std::vector<const Energy*> energies;
  for (const auto& part : parts) energies.push_back(&part.energy());
  return energies;
}

std::vector<const Energy*> energies_of(const std::vector<const ElementDerivatives*>& parts) {
  std::vector<const Energy*> energies;
  for (const ElementDerivatives* part : parts) energies.push_back(&part->energy());
  return energies;
}

}  // namespace

Linearization::Linearization(const Problem& problem, ColumnOrder order) : columns_(problem) {
  if (columns_.dimension() > kMostCoordinates) {
    throw InputError(
        fmt::format("the problem has {} coordinates; solver.method gauss_newton takes at most {}: "
                    "set solver.method to ceres",
                    columns_.dimension(), kMostCoordinates));
  }
  for (const WeightedEnergy& term : problem.terms) {
    structure_.push_back(term.structure());
    if (term.structure() == Structure::kKronecker) kronecker_.emplace_back(term, columns_);
  }
  NodeBlocks blocks(columns_.first(), energies_of(kronecker_));
  for (std::size_t i = 0; i < kronecker_.size(); ++i) {
    blocks.add_kronecker(i, kronecker_[i].weight(), kronecker_[i].coefficients());
  }
  if (order == ColumnOrder::kFillReducing) {
    columns_.reorder(column_order(blocks, columns_.ranks(), columns_.count()));
  }
  A_ = blocks.lower(columns_.ranks(), columns_.count());
  for (const WeightedEnergy& term : problem.terms) {
    const Structure structure = term.structure();
    if (structure == Structure::kLinear) linear_.emplace_back(term, problem.x, columns_);
    if (structure == Structure::kNonlinear) nonlinear_.emplace_back(term, problem.x, columns_);
  }
  for (const LinearPart& part : linear_) derivatives_.push_back(&part.derivatives());
  for (const NonlinearPart& part : nonlinear_) derivatives_.push_back(&part.derivatives());
  for (const auto* part : derivatives_) {
    scratch_.resize(std::max(scratch_.size(), std::size_t(part->width())));
  }
  for (ColumnBlock* block : {&G_, &delta_, &Adelta_}) {
    *block = ColumnBlock::Zero(4, columns_.count());
  }
  for (ColumnBlock* block : {&X_, &all_G_}) *block = ColumnBlock::Zero(4, columns_.columns());
  Jtr_ = Eigen::VectorXd::Zero(unknowns());
  set_targets();
}

bool Linearization::change_elements(const Problem& problem, std::size_t term) {
  const WeightedEnergy& changed = problem.terms[term];
  if (structure_[term] != Structure::kKronecker) return false;
  if (changed.structure() != Structure::kKronecker) return false;
  const auto before = structure_.begin() + static_cast<std::ptrdiff_t>(term);
  KroneckerPart& part = kronecker_[std::count(structure_.begin(), before, Structure::kKronecker)];
  if (columns_of_element(*changed.energy) != part.coefficients().rows()) return false;
  KroneckerPart next(changed, columns_);
  const KroneckerPart::Difference difference = part.difference_to(next);
  if (std::ssize(difference.added) + std::ssize(difference.removed) > LowRankChange::kMostRank)
    return false;
  LowRankChange change = change_of_A_;
  for (const int e : difference.removed) {
    change.add(-part.weight(), part.free_coefficients(e, columns_));
  }
  for (const int e : difference.added) {
    change.add(next.weight(), next.free_coefficients(e, columns_));
  }
  if (change.rank() > LowRankChange::kMostRank) return false;
  change_of_A_ = std::move(change);
  part = std::move(next);
  part.set_targets();
  return true;
}

void Linearization::set_targets() {
  for (KroneckerPart& part : kronecker_) part.set_targets();
}

double Linearization::evaluate(const Unknowns& x) {
  X_.topRows(x.dimension()) = x.X;
  all_G_.setZero();
  kronecker_cost_ = 0;
  for (const KroneckerPart& part : kronecker_) kronecker_cost_ += part.cost(X_, all_G_);
  for (int c = 0; c < columns_.columns(); ++c) {
    if (columns_.rank(c) >= 0) G_.col(columns_.rank(c)) = all_G_.col(c);
  }
  return exact_cost_ = kronecker_cost_ + evaluate_others(x);
}

double Linearization::evaluate_others(const Unknowns& x) {
  double sum = 0;
  for (LinearPart& part : linear_) sum += part.cost(x);
  for (NonlinearPart& part : nonlinear_) sum += part.cost(x);
  return sum;
}

std::vector<double> Linearization::cost_by_term(const Unknowns& x) {
  X_.topRows(x.dimension()) = x.X;
  auto kronecker = kronecker_.begin();
  auto linear = linear_.begin();
  auto nonlinear = nonlinear_.begin();
  std::vector<double> result;
  for (const Structure structure : structure_) {
    if (structure == Structure::kKronecker) result.push_back((kronecker++)->cost(X_));
    if (structure == Structure::kLinear) result.push_back((linear++)->cost(x));
    if (structure == Structure::kNonlinear) result.push_back((nonlinear++)->cost(x));
  }
  return result;
}

void Linearization::linearize(const Unknowns& x) {
  scatter(G_, columns_.dimension(), Jtr_);
  for (LinearPart& part : linear_) part.linearize(x, Jtr_);
  for (NonlinearPart& part : nonlinear_) part.linearize(x, Jtr_);
}

void Linearization::second_order(const Unknowns& x, const Eigen::VectorXd& delta,
                                 Eigen::VectorXd& q) {
  q.setZero();
  for (NonlinearPart& part : nonlinear_) part.add_second_order(x, delta, q, scratch_.data());
}

void Linearization::set_direction(const Eigen::VectorXd& delta) {
  gather(delta, columns_.dimension(), delta_);
  Adelta_.setZero();
  add_product(A_, delta_, Adelta_);
  change_of_A_.add_product(delta_, Adelta_);
  slope_ = dot(G_, delta_);
  curvature_ = dot(delta_, Adelta_);
}

void Linearization::step(const Unknowns& x, const Eigen::VectorXd& delta, double scale,
                         Unknowns& to) const {
  const int d = columns_.dimension();
  for (int c = 0; c < columns_.columns(); ++c) {
    const double* from = x.X.data() + std::ptrdiff_t(c) * d;
    double* result = to.X.data() + std::ptrdiff_t(c) * d;
    const int first = columns_.unknown(0, c);
    for (int i = 0; i < d; ++i)
      result[i] = first < 0 ? from[i] : from[i] + scale * delta[first + i];
  }
}

double Linearization::evaluate_step(const Unknowns& to, double scale) {
  scale_ = scale;
  const double quadratic = kronecker_cost_ + scale * (2 * slope_ + scale * curvature_);
  trial_kronecker_cost_ = quadratic < 0 ? 0 : quadratic;  // NaN stays NaN
  trial_other_cost_ = evaluate_others(to);
  return trial_kronecker_cost_ + trial_other_cost_;
}

double Linearization::linearize_step(const Unknowns& to) {
  double cost = trial_kronecker_cost_ + trial_other_cost_;
  if (cost < kRefresh * exact_cost_) {
    cost = evaluate(to);
  } else {
    kronecker_cost_ = trial_kronecker_cost_;
    G_ += scale_ * Adelta_;
  }
  linearize(to);
  return cost;
}

SparseMatrix Linearization::nearest_of_others() const {
  NodeBlocks blocks(columns_.first(), energies_of(derivatives_));
  for (std::size_t i = 0; i < derivatives_.size(); ++i) {
    const ElementDerivatives& part = *derivatives_[i];
    if (part.couples_coordinates()) {
      part.add_mean_diagonals(i, blocks);
    } else {  // a Kronecker term whose loss scales the coefficients of each element by √ρ′
      const Eigen::VectorXd& root = nonlinear_[i - linear_.size()].root();
      Eigen::MatrixXd a(columns_of_element(part.energy()), part.energy().size());
      part.energy().coefficients(a.data());
      blocks.add_kronecker(i, part.weight(), a * root.asDiagonal());
    }
  }
  return blocks.lower(columns_.ranks(), columns_.count());
}

SparseMatrix Linearization::structure_of_others(bool couple_coordinates) const {
  std::vector<const ElementDerivatives*> such;
  for (const ElementDerivatives* part : derivatives_) {
    if (part->couples_coordinates() == couple_coordinates) such.push_back(part);
  }
  NodeBlocks blocks(columns_.first(), energies_of(such));
  for (std::size_t i = 0; i < such.size(); ++i) blocks.add_structure(i);
  return blocks.lower(columns_.ranks(), columns_.count());
}

}  // namespace deformlab
