#include "solvers/normal_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformlab {
namespace {

int columns_read(const Energy& energy) { return energy.jacobian_columns() / energy.dimension(); }

}  // namespace

NormalEquations::NormalEquations(const Stage& stage) : dimension_(stage.x.dimension()) {
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
    Part part{energy.get(), weight, {}, {}, {}, {}};
    part.r.resize(energy->rows(), energy->size());
    add_columns(x, part);
    add_constant(x, part);
    parts_.push_back(std::move(part));
  }
  A_.resize(x.X.cols(), x.X.cols());
  assemble_separable();
  assemble_structure();
}

void NormalEquations::add_columns(const Unknowns& x, Part& part) const {
  const Energy& energy = *part.energy;
  for (int e = 0; e < energy.size(); ++e) {
    for (int a = 0; a < energy.arity(); ++a) {
      const int first = x.first[energy.nodes(e)[a]];
      for (int c = 0; c < energy.argument(a).count; ++c) part.column.push_back(first + c);
    }
  }
}

// The derivative of a separable term is J = aᵀ ⊗ I_d: its first row says it all.
void NormalEquations::add_constant(const Unknowns& x, Part& part) {
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
void NormalEquations::assemble_separable() {
  Triplets entries;
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

// visit(p, q, row, column) for every pair of entries p, q of an element whose place is free and in
// H's lower triangle.
template <class Visit>
void NormalEquations::for_each_pair(const Part& part, int e, Visit&& visit) const {
  const int d = dimension_, n = part.energy->jacobian_columns();
  const int* column = part.column.data() + std::ptrdiff_t(e) * (n / d);
  for (int p = 0; p < n; ++p) {
    const int row = place(p % d, column[p / d]);
    for (int q = 0; q < n && row >= 0; ++q) {
      const int col = place(q % d, column[q / d]);
      if (col >= 0 && row >= col) visit(p, q, row, col);
    }
  }
}

void NormalEquations::assemble_structure() {
  Triplets triplets;
  for (int c = 0; c < A_.outerSize(); ++c) {
    for (SparseMatrix::InnerIterator it(A_, c); it; ++it) {
      for (int i = 0; i < dimension_; ++i) {
        const auto [col, row] = std::minmax({place(i, c), place(i, static_cast<int>(it.row()))});
        if (col >= 0) triplets.emplace_back(row, col, it.value());
      }
    }
  }
  for (const Part& part : parts_) {
    if (part.energy->structure() == Structure::kSeparable) continue;
    const bool constant = part.energy->structure() == Structure::kLinear;
    const int width = part.energy->jacobian_columns();
    for (int e = 0; e < part.energy->size(); ++e) {
      const auto J = part.J.middleCols(std::ptrdiff_t(e) * width, width);
      for_each_pair(part, e, [&](int p, int q, int row, int col) {
        const double value = constant ? part.weight * J.col(p).dot(J.col(q)) : 0;
        triplets.emplace_back(row, col, value);
      });
    }
  }
  for (int i = 0; i < unknowns(); ++i) triplets.emplace_back(i, i, 0);  // for dampings
  H_.resize(unknowns(), unknowns());
  H_.setFromTriplets(triplets.begin(), triplets.end());
  constant_ = Eigen::Map<const Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros());

  for (Part& part : parts_) {
    part.target.clear();
    if (part.energy->structure() != Structure::kNonlinear) continue;
    for (int e = 0; e < part.energy->size(); ++e) {
      for_each_pair(part, e, [&](int, int, int row, int col) {
        const int* begin = H_.innerIndexPtr() + H_.outerIndexPtr()[col];
        const int* end = H_.innerIndexPtr() + H_.outerIndexPtr()[col + 1];
        const int* found = std::lower_bound(begin, end, row);
        part.target.push_back(static_cast<int>(found - H_.innerIndexPtr()));
      });
    }
  }
}

void NormalEquations::reorder(const Eigen::VectorXi& order) {
  std::vector<int> place_of(order.size());
  for (int i = 0; i < order.size(); ++i) place_of[order[i]] = i;
  for (int& place : place_) {
    if (place >= 0) place = place_of[place];
  }
  assemble_structure();
}

double NormalEquations::evaluate(const Unknowns& x) {
  double sum = 0;
  for (Part& part : parts_) {
    part.energy->residuals(x, part.r.data());
    sum += part.weight * part.r.squaredNorm();
  }
  return sum;
}

std::vector<double> NormalEquations::cost_by_term() const {
  std::vector<double> result;
  for (const Part& part : parts_) result.push_back(part.weight * part.r.squaredNorm());
  return result;
}

void NormalEquations::linearize(const Unknowns& x) {
  Eigen::Map<Eigen::VectorXd>(H_.valuePtr(), H_.nonZeros()) = constant_;
  Jtr_.setZero();
  for (Part& part : parts_) {
    if (part.energy->structure() == Structure::kNonlinear) {
      part.energy->jacobians(x, part.J.data());
      add_JtJ(part);
    }
    add_Jtr(part);
  }
}

void NormalEquations::add_JtJ(const Part& part) {
  const int width = part.energy->jacobian_columns();
  double* values = H_.valuePtr();
  const int* target = part.target.data();
  for (int e = 0; e < part.energy->size(); ++e) {
    const auto J = part.J.middleCols(std::ptrdiff_t(e) * width, width);
    for_each_pair(part, e, [&](int p, int q, int, int) {
      values[*target++] += part.weight * J.col(p).dot(J.col(q));
    });
  }
}

void NormalEquations::add_Jtr(const Part& part) {
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

void NormalEquations::step(const Unknowns& from, const Eigen::VectorXd& delta, double scale,
                           Unknowns& to) const {
  const double* x = from.X.data();
  double* y = to.X.data();
  for (std::size_t i = 0; i < place_.size(); ++i) {
    y[i] = place_[i] < 0 ? x[i] : x[i] + scale * delta[place_[i]];
  }
}

}  // namespace deformlab
