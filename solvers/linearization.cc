#include "solvers/linearization.h"

#include <cmath>
#include <utility>

namespace deformlab {
namespace {

int columns_read(const Energy& energy) { return energy.jacobian_columns() / energy.dimension(); }

}  // namespace

Linearization::Linearization(const Stage& stage) : dimension_(stage.x.dimension()) {
  check(stage);
  const Unknowns& x = stage.x;
  place_.assign(x.X.size(), -1);
  int free = 0;
  for (int j = 0; j < x.nodes(); ++j) {
    if (stage.fixed[j]) continue;
    const int begin = x.first[j] * dimension_, end = x.first[j + 1] * dimension_;
    for (int i = begin; i < end; ++i) place_[i] = free++;
  }
  Jtr_ = Eigen::VectorXd::Zero(free);
  for (const auto& [energy, weight] : stage.terms) {
    Part part{energy.get(), weight, {}, {}, {}};
    part.r.resize(energy->rows(), energy->size());
    add_columns(x, part);
    add_constant(x, part);
    parts_.push_back(std::move(part));
  }
  A_.resize(x.X.cols(), x.X.cols());
  assemble_separable();
}

void Linearization::add_columns(const Unknowns& x, Part& part) const {
  const Energy& energy = *part.energy;
  for (int e = 0; e < energy.size(); ++e) {
    for (int a = 0; a < energy.arity(); ++a) {
      const int first = x.first[energy.nodes(e)[a]];
      for (int c = 0; c < energy.argument(a).count; ++c) part.column.push_back(first + c);
    }
  }
}

// The derivative of a separable term is J = aᵀ ⊗ I_d: its first row says it all.
void Linearization::add_constant(const Unknowns& x, Part& part) {
  const Energy& energy = *part.energy;
  const int width = energy.jacobian_columns();
  Eigen::MatrixXd J(energy.rows(), std::ptrdiff_t(width) * energy.size());
  if (energy.structure() == Structure::kNonlinear) {
    part.J = std::move(J);
    return;
  }
  energy.jacobians(x, J.data());
  if (energy.structure() == Structure::kLinear) {
    part.J = std::move(J);
    return;
  }
  part.J.resize(columns_read(energy), energy.size());
  for (int e = 0; e < energy.size(); ++e) {
    for (int c = 0; c < columns_read(energy); ++c) {
      part.J(c, e) = J(0, std::ptrdiff_t(width) * e + c * dimension_);
    }
  }
}

// A = CᵀC with one row of C an element: √w a. Zero coefficients leave no trace in the structure:
// E_reg does not couple R_j with R_k.
void Linearization::assemble_separable() {
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (const Part& part : parts_) {
    if (part.energy->structure() != Structure::kSeparable) continue;
    for (int e = 0; e < part.energy->size(); ++e, ++row) {
      const int* column = part.column.data() + e * part.J.rows();
      for (Eigen::Index p = 0; p < part.J.rows(); ++p) {
        const double value = std::sqrt(part.weight) * part.J(p, e);
        if (value != 0) entries.emplace_back(row, column[p], value);
      }
    }
  }
  SparseMatrix C(row, A_.cols());
  C.setFromTriplets(entries.begin(), entries.end());
  A_ = SparseMatrix(C.transpose() * C).triangularView<Eigen::Lower>();
}

double Linearization::evaluate(const Unknowns& x) {
  double sum = 0;
  for (Part& part : parts_) {
    part.energy->residuals(x, part.r.data());
    sum += part.weight * part.r.squaredNorm();
  }
  return sum;
}

std::vector<double> Linearization::cost_by_term() const {
  std::vector<double> result;
  for (const Part& part : parts_) result.push_back(part.weight * part.r.squaredNorm());
  return result;
}

void Linearization::linearize(const Unknowns& x) {
  Jtr_.setZero();
  for (Part& part : parts_) {
    if (part.energy->structure() == Structure::kNonlinear) {
      part.energy->jacobians(x, part.J.data());
    }
    add_Jtr(part);
  }
}

void Linearization::add_Jtr(const Part& part) {
  const int d = dimension_, n = columns_read(*part.energy);
  const bool separable = part.energy->structure() == Structure::kSeparable;
  const int* column = part.column.data();
  for (int e = 0; e < part.energy->size(); ++e, column += n) {
    const auto r = part.r.col(e);
    for (int c = 0; c < n; ++c) {
      for (int i = 0; i < d; ++i) {
        const int at = place(i, column[c]);
        if (at < 0) continue;
        const std::ptrdiff_t p = (std::ptrdiff_t(e) * n + c) * d + i;
        Jtr_[at] += part.weight * (separable ? part.J(c, e) * r[i] : part.J.col(p).dot(r));
      }
    }
  }
}

void Linearization::step(const Unknowns& from, const Eigen::VectorXd& delta, double scale,
                         Unknowns& to) const {
  const double* x = from.X.data();
  double* y = to.X.data();
  for (std::size_t i = 0; i < place_.size(); ++i) {
    y[i] = place_[i] < 0 ? x[i] : x[i] + scale * delta[place_[i]];
  }
}

}  // namespace deformlab
