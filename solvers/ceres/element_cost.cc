#include "solvers/ceres/element_cost.h"

#include <algorithm>
#include <cmath>

#include "energies/room.h"

namespace deformlab {
namespace {

constexpr int kUsualWidth = 256;  // a wider Jacobian needs memory from the heap

}  // namespace

ElementCost::ElementCost(const Energy& energy, int e, double weight, Unknowns& x, bool by_column,
                         Trouble& trouble)
    : energy_(energy), e_(e), scale_(std::sqrt(weight)), trouble_(trouble) {
  set_num_residuals(energy.rows());
  std::vector<const double*> nodes;
  for (const int node : energy.nodes(e)) nodes.push_back(x.node(node));
  constant_.resize(energy.rows(), energy.jacobian_columns());
  Eigen::VectorXd r(energy.rows());
  energy.evaluate(e, nodes.data(), r.data(), constant_.data());
  const bool constant = energy.structure() != Structure::kNonlinear;
  for (const Piece& piece : by_column ? columns(x) : whole_nodes(x)) {
    if (constant && constant_.middleCols(piece.first, piece.count).isZero(0)) continue;
    pieces_.push_back(piece);
    mutable_parameter_block_sizes()->push_back(piece.size);
  }
  if (!constant) constant_.resize(0, 0);
}

std::vector<double*> ElementCost::blocks() const {
  std::vector<double*> result;
  for (const Piece& piece : pieces_) result.push_back(piece.block);
  return result;
}

std::vector<ElementCost::Piece> ElementCost::whole_nodes(Unknowns& x) const {
  std::vector<Piece> result;
  for (int a = 0, first = 0; a < energy_.arity(); first += read(a++)) {
    const int node = energy_.nodes(e_)[a];
    result.push_back(
        {first, read(a), x.dimension() * x.columns(node), parameter_block(x, x.first[node])});
  }
  return result;
}

std::vector<ElementCost::Piece> ElementCost::columns(Unknowns& x) const {
  std::vector<Piece> result;
  const int d = x.dimension();
  for (int a = 0; a < energy_.arity(); ++a) {
    const int begin = x.first[energy_.nodes(e_)[a]];
    for (int c = 0; c < energy_.argument(a).count; ++c) {
      const int first = d * static_cast<int>(result.size());
      result.push_back({first, d, d, parameter_block(x, begin + c)});
    }
  }
  return result;
}

bool ElementCost::Evaluate(const double* const* x, double* residuals, double** jacobians) const {
  try {
    if (evaluate(x, residuals, jacobians)) return true;
    trouble_.keep(energy_);
  } catch (...) {
    trouble_.keep_exception();
  }
  return false;
}

bool ElementCost::evaluate(const double* const* x, double* residuals, double** jacobians) const {
  const int width = energy_.jacobian_columns();
  Room<double, kUsualWidth> entries(width);  // entries without a derivative may have any value
  std::fill_n(entries.data(), width, 0.0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    std::copy_n(x[i], pieces_[i].count, entries.data() + pieces_[i].first);
  }
  Room<const double*, kUsualWidth> nodes(energy_.arity());
  for (int a = 0, first = 0; a < energy_.arity(); first += read(a++)) {
    nodes.data()[a] = entries.data() + first;
  }
  const bool differentiate = jacobians != nullptr && constant_.size() == 0;
  Room<double, kMaxResiduals * kUsualWidth> derivatives(energy_.rows() * width);
  Eigen::Map<Eigen::MatrixXd> J(derivatives.data(), energy_.rows(), width);
  energy_.evaluate(e_, nodes.data(), residuals, differentiate ? J.data() : nullptr);
  Eigen::Map<Eigen::VectorXd> r(residuals, energy_.rows());
  r *= scale_;
  if (jacobians != nullptr && differentiate) copy_blocks(J, jacobians);
  if (jacobians != nullptr && !differentiate) copy_blocks(constant_, jacobians);
  return r.allFinite() && (!differentiate || J.allFinite());
}

// Ceres wants a row-major Jacobian for each parameter block.
template <class Jacobian>
void ElementCost::copy_blocks(const Jacobian& J, double** jacobians) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (jacobians[i] == nullptr) continue;
    double* to = jacobians[i];
    for (int row = 0; row < energy_.rows(); ++row, to += piece.size) {
      for (int k = 0; k < piece.count; ++k) to[k] = scale_ * J(row, piece.first + k);
      std::fill(to + piece.count, to + piece.size, 0.0);
    }
  }
}

void WeightedLoss::Evaluate(double s, double rho[3]) const {
  std::fill_n(rho, 3, 0.0);
  try {
    loss_.Evaluate(s, rho);
  } catch (...) {
    trouble_.keep_exception();
  }
  for (int i = 0; i < 3; ++i) rho[i] *= weight_;
}

}  // namespace deformlab
