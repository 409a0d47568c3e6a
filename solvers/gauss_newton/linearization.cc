#include "solvers/gauss_newton/linearization.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/gauss_newton/linearization/column_order.h"
namespace deformlab {
namespace {

// F has fallen to this share since it was summed over residuals: rounding then counts, and it is
// summed anew.
constexpr double kRefresh = 1e-8;

// Columns of zeros behind JᵀJ: the last block is read by fours.
constexpr int kReadBeyond = 4;

// Jᵀ r of every element.
void multiply_transposed(const Linearization::Part& part, Eigen::MatrixXd& Jtr) {
  const Eigen::Index n = Jtr.rows();
  for (Eigen::Index e = 0; e < Jtr.cols(); ++e) {
    const auto J = part.J.middleCols(n * e, n);
    for (Eigen::Index p = 0; p < n; ++p) Jtr(p, e) = J.col(p).dot(part.r.col(e));
    if (part.loss) Jtr.col(e) *= part.root[e];
  }
}

// J of every element times √ρ′.
void take_loss(Linearization::Part& part) {
  const Eigen::Index n = part.Jtr.rows();
  for (Eigen::Index e = 0; e < part.r.cols(); ++e) {
    part.root[e] = std::sqrt(loss_slope(*part.loss, part.r.col(e).squaredNorm()));
    part.J.middleCols(n * e, n) *= part.root[e];
  }
}

int columns_read(const Energy& energy) { return energy.jacobian_columns() / energy.dimension(); }

}  // namespace

Linearization::Linearization(const Problem& problem)
    : dimension_(problem.x.dimension()), first_(problem.x.first) {
  check(problem);
  const Unknowns& x = problem.x;
  int free = 0;
  rank_.assign(x.X.cols(), -1);
  for (int j = 0; j < x.nodes(); ++j) {
    for (int c = x.first[j]; c < x.first[j + 1] && !problem.fixed[j]; ++c) rank_[c] = free++;
  }
  for (ColumnBlock* block : {&G_, &delta_, &Adelta_}) *block = ColumnBlock::Zero(4, free);
  for (ColumnBlock* block : {&X_, &all_G_}) *block = ColumnBlock::Zero(4, x.X.cols());
  Jtr_ = Eigen::VectorXd::Zero(dimension_ * free);
  place_.resize(rank_.size() * dimension_);
  number();
  for (const WeightedEnergy& term : problem.terms) add_part(problem, term);
  sum_kronecker();
  set_targets();
}

std::vector<const Linearization::Part*> Linearization::parts_where(
    const std::function<bool(const Part&)>& such) const {
  std::vector<const Part*> result;
  for (const Part& part : parts_) {
    if (such(part)) result.push_back(&part);
  }
  return result;
}

NodeBlocks Linearization::blocks_of(const std::vector<const Part*>& parts) const {
  std::vector<const Energy*> energies;
  for (const Part* part : parts) energies.push_back(part->energy);
  return {first_, energies};
}

void Linearization::sum_kronecker() {
  const auto parts = parts_where([](const Part& part) { return part.kronecker(); });
  blocks_ = std::make_unique<NodeBlocks>(blocks_of(parts));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    blocks_->add_kronecker(i, parts[i]->weight, parts[i]->J);
  }
}

void Linearization::set_targets() {
  for (Part& part : parts_) {
    if (!part.kronecker()) continue;
    part.energy->offsets(part.r.data());
    part.b.topRows(part.r.rows()) = part.r;
  }
}

void Linearization::number() {
  for (std::size_t c = 0; c < rank_.size(); ++c) {
    for (int i = 0; i < dimension_; ++i) {
      place_[c * dimension_ + i] = rank_[c] < 0 ? -1 : dimension_ * rank_[c] + i;
    }
  }
}

void Linearization::order_columns() {
  const std::vector<int> order = column_order(*blocks_, rank_, free_columns());
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  for (int& rank : rank_) {
    if (rank >= 0) rank = place[rank];
  }
  number();
}

void Linearization::assemble() {
  A_ = blocks_->lower(rank_, free_columns());
  blocks_.reset();
}

void Linearization::add_part(const Problem& problem, const WeightedEnergy& term) {
  const Energy& energy = *term.energy;
  const Unknowns& x = problem.x;
  Part part{.energy = &energy, .weight = term.weight, .loss = term.loss};
  if (part.loss) part.root.setOnes(energy.size());
  std::vector<int> counts;
  for (int a = 0; a < energy.arity(); ++a) counts.push_back(energy.argument(a).count);
  part.column.reserve(std::size_t(energy.size()) * columns_read(energy));
  std::size_t a = 0;
  for (const int j : energy.nodes()) {
    for (int c = 0; c < counts[a]; ++c) part.column.push_back(x.first[j] + c);
    a = a + 1 < counts.size() ? a + 1 : 0;
  }
  const int width = energy.jacobian_columns();
  const std::ptrdiff_t all = std::ptrdiff_t(width) * energy.size();
  part.r.resize(energy.rows(), energy.size());
  if (!part.kronecker()) part.Jtr.resize(width, energy.size());
  if (part.structure() == Structure::kNonlinear) part.bent.resize(width, energy.size());
  local_.resize(std::max<std::size_t>(local_.size(), width));
  if (part.kronecker()) {
    part.J.resize(columns_read(energy), energy.size());
    part.b = ColumnBlock::Zero(4, energy.size());
    energy.coefficients(part.J.data());
  } else if (part.square()) {
    part.JtJ.setZero(width, all + kReadBeyond);
    energy.normal_equations(x, part.JtJ.data(), part.Jtr.data());
  } else {
    part.J.resize(energy.rows(), all);
    energy.jacobians(x, part.J.data());
  }
  parts_.push_back(std::move(part));
}

SparseMatrix Linearization::nearest_of_others() const {
  const auto parts = parts_where([](const Part& part) { return !part.kronecker(); });
  NodeBlocks blocks = blocks_of(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = *parts[i];
    if (part.square()) {
      blocks.add_mean_diagonals(i, part.weight, part.JtJ);
    } else if (part.energy->structure() == Structure::kKronecker) {  // but for its loss
      Eigen::MatrixXd a(columns_read(*part.energy), part.energy->size());
      part.energy->coefficients(a.data());
      blocks.add_kronecker(i, part.weight, a * part.root.asDiagonal());
    } else {
      const int width = part.energy->jacobian_columns();
      Eigen::MatrixXd JtJ(width, part.J.cols());
      for (Eigen::Index c = 0; c < part.J.cols(); c += width) {
        const auto J = part.J.middleCols(c, width);
        JtJ.middleCols(c, width) = J.transpose() * J;
      }
      blocks.add_mean_diagonals(i, part.weight, JtJ);
    }
  }
  return blocks.lower(rank_, free_columns());
}

SparseMatrix Linearization::structure_where(const std::function<bool(const Part&)>& such) const {
  const auto parts = parts_where(such);
  NodeBlocks blocks = blocks_of(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) blocks.add_structure(i);
  return blocks.lower(rank_, free_columns());
}

double Linearization::evaluate(const Unknowns& x) {
  X_.topRows(dimension_) = x.X;
  all_G_.setZero();
  kronecker_ = 0;
  for (Part& part : parts_) {
    if (!part.kronecker()) continue;
    kronecker_ += part.weight * energy(part.as_kronecker(), X_, part.weight, all_G_);
  }
  for (std::size_t c = 0; c < rank_.size(); ++c) {
    if (rank_[c] >= 0) G_.col(rank_[c]) = all_G_.col(c);
  }
  return exact_ = kronecker_ + evaluate_others(x);
}

double Linearization::evaluate_others(const Unknowns& x) {
  double sum = 0;
  for (Part& part : parts_) {
    if (part.kronecker()) continue;
    part.energy->residuals(x, part.r.data());
    sum += part.weight * squared_sum(part.r, part.loss.get());
  }
  return sum;
}

std::vector<double> Linearization::cost_by_term(const Unknowns& x) {
  X_.topRows(dimension_) = x.X;
  std::vector<double> result;
  for (Part& part : parts_) {
    if (!part.kronecker()) part.energy->residuals(x, part.r.data());
    result.push_back(part.weight * (part.kronecker() ? energy(part.as_kronecker(), X_)
                                                     : squared_sum(part.r, part.loss.get())));
  }
  return result;
}

void Linearization::linearize(const Unknowns& x) {
  scatter(G_, Jtr_);
  for (Part& part : parts_) {
    if (part.kronecker()) continue;
    if (part.square()) {
      part.energy->normal_equations(x, part.JtJ.data(), part.Jtr.data());
    } else if (part.structure() == Structure::kNonlinear) {
      part.energy->jacobians(x, part.J.data());
      if (part.loss) take_loss(part);
    }
    if (!part.square()) multiply_transposed(part, part.Jtr);
    add(part, part.Jtr, Jtr_);
  }
  linearized();
}

// sum += w Σ of the elements' d entries a column.
void Linearization::add(const Part& part, const Eigen::MatrixXd& Jtr, Eigen::VectorXd& sum) const {
  const double* entry = Jtr.data();
  for (const int column : part.column) {
    for (int i = 0; i < dimension_; ++i, ++entry) {
      const int at = place(i, column);
      if (at >= 0) sum[at] += part.weight * *entry;
    }
  }
}

void Linearization::bend(const Unknowns& x, const Eigen::VectorXd& delta, Eigen::VectorXd& q) {
  q.setZero();
  for (Part& part : parts_) {
    if (part.structure() != Structure::kNonlinear) continue;
    if (part.square()) {
      part.energy->transposed_products(x, part.r.data(), part.bent.data());
    } else {
      multiply_transposed(part, part.bent);
    }
    part.bent -= part.Jtr;
    const int n = static_cast<int>(part.Jtr.rows());
    Eigen::Map<Eigen::VectorXd> own(local_.data(), n);
    for (int e = 0; e < part.energy->size(); ++e) {
      for (int p = 0; p < n; ++p) {
        const int at = place(p % dimension_, part.column[(std::ptrdiff_t(e) * n + p) / dimension_]);
        own[p] = at < 0 ? 0 : delta[at];
      }
      const std::ptrdiff_t first = std::ptrdiff_t(e) * n;
      if (part.square()) {
        part.bent.col(e).noalias() -= part.JtJ.middleCols(first, n).lazyProduct(own);
      } else {
        const auto J = part.J.middleCols(first, n);
        for (Eigen::Index row = 0; row < J.rows(); ++row) {
          part.bent.col(e) -= J.row(row).dot(own) * J.row(row).transpose();
        }
      }
    }
    add(part, part.bent, q);
  }
}

void Linearization::set_direction(const Eigen::VectorXd& delta) {
  gather(delta, delta_);
  Adelta_.setZero();
  add_product(A_, delta_, Adelta_);
  slope_ = dot(G_, delta_);
  curvature_ = dot(delta_, Adelta_);
}

double Linearization::evaluate_step(const Unknowns& to, double scale) {
  scale_ = scale;
  share_ = std::max(0.0, kronecker_ + scale * (2 * slope_ + scale * curvature_));
  others_ = evaluate_others(to);
  return share_ + others_;
}

double Linearization::linearize_step(const Unknowns& to) {
  double cost = share_ + others_;
  if (cost < kRefresh * exact_) {
    cost = evaluate(to);
  } else {
    kronecker_ = share_;
    G_ += scale_ * Adelta_;
  }
  linearize(to);
  return cost;
}

void Linearization::step(const Unknowns& from, const Eigen::VectorXd& delta, double scale,
                         Unknowns& to) const {
  const double* x = from.X.data();
  double* y = to.X.data();
  for (std::size_t i = 0; i < place_.size(); ++i) {
    y[i] = place_[i] < 0 ? x[i] : x[i] + scale * delta[place_[i]];
  }
}

void Linearization::gather(const Eigen::VectorXd& x, ColumnBlock& block) const {
  for (std::size_t c = 0; c < rank_.size(); ++c) {
    for (int i = 0; i < dimension_ && rank_[c] >= 0; ++i) {
      block(i, rank_[c]) = x[place_[c * dimension_ + i]];
    }
  }
}

void Linearization::scatter(const ColumnBlock& block, Eigen::VectorXd& x) const {
  for (std::size_t c = 0; c < rank_.size(); ++c) {
    for (int i = 0; i < dimension_ && rank_[c] >= 0; ++i) {
      x[place_[c * dimension_ + i]] = block(i, rank_[c]);
    }
  }
}

}  // namespace deformlab
