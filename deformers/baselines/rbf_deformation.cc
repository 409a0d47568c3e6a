#include "deformers/baselines/rbf_deformation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include "deformers/handle_checks.h"
#include "geometry/transfer/cofactors.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Handles that are closer than this share a centre, and p is constant in a direction in which the
// extent of the handles is smaller [handles' extent]. The fit would be ill-conditioned otherwise.
constexpr double kThin = 1e-4;
constexpr Eigen::Index kChunk = 512;  // vertices per evaluation of a basis that is not stored

Eigen::Matrix3Xd side_by_side(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  Eigen::Matrix3Xd result(3, a.cols() + b.cols());
  result << a, b;
  return result;
}

}  // namespace

RbfDeformation::RbfDeformation(Shape rest, const RbfOptions& options)
    : Baseline(std::move(rest)), options_(options) {
  deformlab::check(rest_, "the shape");
  check_options(options_);
  compile({});
}

void RbfDeformation::compile_handles() {
  points_ = side_by_side(rest_.V(Eigen::all, handles_.fixed),
                         side_by_side(rest_.V(Eigen::all, handles_.moved), handles_.points));
  basis_.resize(0, 0);
  if (points_.cols() == 0) {
    compilation_notes_.emplace_back("there is no handle: the shape stays where it is");
    return;
  }
  const double extent = bounding_box_diagonal(points_);
  extent_ = extent > 0 ? extent : 1;
  choose_centers();
  choose_polynomials();
  factorize();
  const double bytes = 8.0 * static_cast<double>(fit_.cols()) * double(rest_.V.cols());
  if (bytes <= 1e6 * options_.megabytes) basis_ = basis(rest_.V);
}

void RbfDeformation::choose_centers() {
  std::vector<Eigen::Index> chosen{0};
  Eigen::RowVectorXd distance = (points_.colwise() - points_.col(0)).colwise().norm();
  const Eigen::Index most = std::min<Eigen::Index>(points_.cols(), options_.max_centers);
  while (std::ssize(chosen) < most) {
    Eigen::Index next = 0;
    if (distance.maxCoeff(&next) <= kThin * extent_) break;
    chosen.push_back(next);
    distance = distance.cwiseMin((points_.colwise() - points_.col(next)).colwise().norm());
  }
  std::sort(chosen.begin(), chosen.end());
  centers_ = points_(Eigen::all, chosen);
  if (centers_.cols() == points_.cols()) return;
  compilation_notes_.push_back(
      fmt::format("{} centres for {} handles: they are fitted by least squares, not interpolated",
                  centers_.cols(), points_.cols()));
}

void RbfDeformation::choose_polynomials() {
  origin_ = centers_.rowwise().mean();
  const Eigen::Matrix3Xd X = (centers_.colwise() - origin_) / extent_;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(X * X.transpose(), Eigen::ComputeFullU);
  const Eigen::Vector3d thickness = (svd.singularValues() / double(X.cols())).cwiseSqrt();
  const Eigen::Index k = (thickness.array() > kThin).count();
  axes_ = svd.matrixU().leftCols(k);
  if (k == 3) return;
  const char* const spans[] = {"are at one point", "lie on a line", "lie in a plane"};
  compilation_notes_.push_back(
      fmt::format("the handles {}: across it the displacement has no linear part", spans[k]));
}

// (n+1+k)×#x: φ for each centre, then 1, then the coordinates along the axes.
Eigen::MatrixXd RbfDeformation::basis(const Eigen::Ref<const Eigen::Matrix3Xd>& x) const {
  const Eigen::Index n = centers_.cols(), k = axes_.cols();
  Eigen::MatrixXd B(n + 1 + k, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Eigen::Vector3d p = x.col(i);
    B.col(i).head(n) =
        ((centers_.colwise() - p).colwise().norm().transpose() / extent_).array().cube();
    B(n, i) = 1;
    B.col(i).tail(k) = axes_.transpose() * (p - origin_) / extent_;
  }
  return B;
}

// The side conditions leave w = Q z, where Q is an orthonormal basis of the orthogonal complement
// of the linear functions at the centres. The unknowns are z and p, as many as there are centres.
void RbfDeformation::factorize() {
  const Eigen::Index n = centers_.cols(), q = 1 + axes_.cols();
  side_conditions_.compute(basis(centers_).bottomRows(q).transpose());
  Eigen::MatrixXd A = basis(points_).transpose();
  A.leftCols(n).applyOnTheRight(side_conditions_.householderQ());
  fit_.compute(A.rightCols(n));
}

// The coefficients of d that fit the displacements (3×#handles) of all handles [length].
Eigen::MatrixXd RbfDeformation::fit(const Eigen::Matrix3Xd& displacements) const {
  const Eigen::Index n = centers_.cols(), q = 1 + axes_.cols();
  const Eigen::MatrixXd y = fit_.solve(displacements.transpose());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n + q, 3);
  w.middleRows(q, n - q) = y.topRows(n - q);
  w.topRows(n).applyOnTheLeft(side_conditions_.householderQ());
  w.bottomRows(q) = y.bottomRows(q);
  return w.transpose();
}

void RbfDeformation::solve(const Eigen::Matrix3Xd& targets, Report& report) {
  Summary& summary = report.solve;
  summary.method = "rbf";
  summary.linear_solver = "dense_qr";
  summary.status = Status::kConverged;
  summary.message = "the fit is linear";
  if (points_.cols() == 0) return;

  report.nodes = static_cast<int>(centers_.cols());
  summary.unknowns = 3 * report.nodes;
  const Eigen::Index moved = targets.cols();
  Eigen::Matrix3Xd displacements = Eigen::Matrix3Xd::Zero(3, points_.cols());
  displacements.rightCols(moved) = targets - points_.rightCols(moved);
  {
    Stopwatch watch(summary.seconds["total"]);
    w_ = fit(displacements);
  }
  {
    Stopwatch watch(report.seconds["transfer"]);
    if (!deform()) {
      summary.status = Status::kFailed;
      summary.message = "the targets are too far away to compute with";
      return;
    }
  }
  const Eigen::Matrix3Xd fitted = w_ * basis(points_);
  summary.final_cost = (fitted - displacements).squaredNorm();
  measure_handles((points_ + fitted).rightCols(moved), targets, report);
}

Eigen::Matrix3Xd RbfDeformation::displacement() const {
  if (basis_.size() > 0) return w_ * basis_;
  Eigen::Matrix3Xd d(3, rest_.V.cols());
  for (Eigen::Index i = 0; i < d.cols(); i += kChunk) {
    const Eigen::Index count = std::min(kChunk, d.cols() - i);
    d.middleCols(i, count) = w_ * basis(rest_.V.middleCols(i, count));
  }
  return d;
}

// The gradient ∂(x + d(x))/∂x, 3×3.
Eigen::Matrix3d RbfDeformation::gradient(const Eigen::Vector3d& x) const {
  const Eigen::Index n = centers_.cols();
  const Eigen::Matrix3Xd from = (-(centers_.colwise() - x)) / extent_;
  const Eigen::Matrix3Xd slope = from * from.colwise().norm().asDiagonal();
  const Eigen::Matrix3d per_extent =
      3 * w_.leftCols(n) * slope.transpose() + w_.rightCols(axes_.cols()) * axes_.transpose();
  return Eigen::Matrix3d::Identity() + per_extent / extent_;
}

// Returns false and changes nothing where a deformed vertex is too far away.
bool RbfDeformation::deform() {
  Eigen::Matrix3Xd V = rest_.V + displacement();
  if (!(V.cwiseAbs().maxCoeff() <= kMostLength)) return false;
  for (const int i : handles_.fixed) V.col(i) = rest_.V.col(i);  // without rounding
  deformed_.V = std::move(V);
  for (Eigen::Index i = 0; i < rest_.N.cols(); ++i) {
    deformed_.N.col(i) = (cofactors(gradient(rest_.V.col(i))) * rest_.N.col(i)).stableNormalized();
  }
  return true;
}

}  // namespace deformlab
