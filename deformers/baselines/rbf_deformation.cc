#include "deformers/baselines/rbf_deformation.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

// Of the handles' extent. Closer handles share a centre, and along a thinner direction p stays
// constant: the fit would not be determined in double precision.
constexpr double kThin = 1e-4;
constexpr Eigen::Index kChunk = 512;  // vertices whose basis is made at once where it is not kept

Eigen::Matrix3Xd side_by_side(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  Eigen::Matrix3Xd result(3, a.cols() + b.cols());
  result << a, b;
  return result;
}

// det(F) F⁻ᵀ, which turns normals also where F is singular.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d result;
  result << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return result;
}

}  // namespace

RbfDeformation::RbfDeformation(Shape rest, const RbfOptions& options)
    : options_(options), rest_(std::move(rest)), deformed_(rest_) {
  deformlab::check(rest_, "the shape");
  check_options(options_);
  compile({});
}

void RbfDeformation::compile(const Handles& handles) {
  check_handles(handles, rest_.V.cols());
  seconds_["compile"] = 0;
  Stopwatch watch(seconds_["compile"]);
  notes_.clear();
  fixed_ = handles.fixed;
  handles_ = side_by_side(rest_.V(Eigen::all, handles.fixed),
                          side_by_side(rest_.V(Eigen::all, handles.moved), handles.points));
  basis_.resize(0, 0);
  if (handles_.cols() == 0) {
    notes_.emplace_back("there is no handle: the shape stays where it is");
    return;
  }
  const double extent = bounding_box_diagonal(handles_);
  extent_ = extent > 0 ? extent : 1;
  choose_centers();
  choose_polynomials();
  factorize();
  const double bytes = 8.0 * static_cast<double>(solve_.cols()) * double(rest_.V.cols());
  if (bytes <= 1e6 * options_.megabytes) basis_ = basis(rest_.V);
}

void RbfDeformation::choose_centers() {
  std::vector<Eigen::Index> chosen{0};
  Eigen::RowVectorXd distance = (handles_.colwise() - handles_.col(0)).colwise().norm();
  const Eigen::Index most = std::min<Eigen::Index>(handles_.cols(), options_.max_centers);
  while (std::ssize(chosen) < most) {
    Eigen::Index next = 0;
    if (distance.maxCoeff(&next) <= kThin * extent_) break;
    chosen.push_back(next);
    distance = distance.cwiseMin((handles_.colwise() - handles_.col(next)).colwise().norm());
  }
  std::sort(chosen.begin(), chosen.end());
  centers_ = handles_(Eigen::all, chosen);
  if (centers_.cols() == handles_.cols()) return;
  notes_.push_back(std::to_string(centers_.cols()) + " centres for " +
                   std::to_string(handles_.cols()) +
                   " handles: they are fitted by least squares, not interpolated");
}

void RbfDeformation::choose_polynomials() {
  origin_ = centers_.rowwise().mean();
  const Eigen::Matrix3Xd X = (centers_.colwise() - origin_) / extent_;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(X * X.transpose(), Eigen::ComputeFullU);
  const Eigen::Vector3d thickness = (svd.singularValues() / double(X.cols())).cwiseSqrt();
  const Eigen::Index k = (thickness.array() > kThin).count();
  axes_ = svd.matrixU().leftCols(k);
  if (k == 3) return;
  const char* const spans[] = {"lie in one place", "lie on a line", "lie in a plane"};
  notes_.push_back(std::string("the handles ") + spans[k] +
                   ": across it the displacement has no linear part");
}

// (n+1+k)×#x: φ of each centre, then 1 and the coordinates along the axes.
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

// The side conditions leave w = Q z, Q an orthonormal basis of what is orthogonal to the linear
// functions at the centres: unknown are z and p, as many as there are centres.
void RbfDeformation::factorize() {
  const Eigen::Index n = centers_.cols(), q = 1 + axes_.cols();
  sides_.compute(basis(centers_).bottomRows(q).transpose());
  Eigen::MatrixXd A = basis(handles_).transpose();
  A.leftCols(n).applyOnTheRight(sides_.householderQ());
  solve_.compute(A.rightCols(n));
}

// The coefficients of d that fit the displacements of the handles (3×#handles) [length].
Eigen::MatrixXd RbfDeformation::fit(const Eigen::Matrix3Xd& displacements) const {
  const Eigen::Index n = centers_.cols(), q = 1 + axes_.cols();
  const Eigen::MatrixXd y = solve_.solve(displacements.transpose());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n + q, 3);
  w.middleRows(q, n - q) = y.topRows(n - q);
  w.topRows(n).applyOnTheLeft(sides_.householderQ());
  w.bottomRows(q) = y.bottomRows(q);
  return w.transpose();
}

Report RbfDeformation::update(const Eigen::Matrix3Xd& targets) {
  const Eigen::Index moved = handles_.cols() - std::ssize(fixed_);
  check_targets(targets, moved);
  Report report;
  report.solve.method = "rbf";
  report.solve.linear_solver = "dense_qr";
  report.solve.status = Status::kConverged;
  report.solve.message = "the fit is linear";
  report.seconds.insert(seconds_.begin(), seconds_.end());
  report.notes = notes_;
  if (handles_.cols() == 0) return report;

  report.nodes = static_cast<int>(centers_.cols());
  report.solve.unknowns = 3 * report.nodes;
  Eigen::Matrix3Xd displacements = Eigen::Matrix3Xd::Zero(3, handles_.cols());
  displacements.rightCols(moved) = targets - handles_.rightCols(moved);
  {
    Stopwatch watch(report.seconds["solve"]);
    w_ = fit(displacements);
  }
  report.solve.seconds["total"] = report.seconds["solve"];
  {
    Stopwatch watch(report.seconds["transfer"]);
    if (!deform()) {
      report.solve.status = Status::kFailed;
      report.solve.message = "the targets are too far away to compute with";
      return report;
    }
  }
  const Eigen::Matrix3Xd fitted = w_ * basis(handles_);
  report.solve.final_cost = (fitted - displacements).squaredNorm();
  measure_handles((handles_ + fitted).rightCols(moved), targets, report);
  return report;
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

// ∂(x + d(x))/∂x.
Eigen::Matrix3d RbfDeformation::gradient(const Eigen::Vector3d& x) const {
  const Eigen::Index n = centers_.cols();
  const Eigen::Matrix3Xd from = (-(centers_.colwise() - x)) / extent_;
  const Eigen::Matrix3Xd slope = from * from.colwise().norm().asDiagonal();
  const Eigen::Matrix3d per_extent =
      3 * w_.leftCols(n) * slope.transpose() + w_.rightCols(axes_.cols()) * axes_.transpose();
  return Eigen::Matrix3d::Identity() + per_extent / extent_;
}

// False, and nothing has changed, where a result is too far away.
bool RbfDeformation::deform() {
  Eigen::Matrix3Xd V = rest_.V + displacement();
  if (!(V.cwiseAbs().maxCoeff() <= kMostLength)) return false;
  for (const int i : fixed_) V.col(i) = rest_.V.col(i);  // free of rounding
  deformed_.V = std::move(V);
  for (Eigen::Index i = 0; i < rest_.N.cols(); ++i) {
    deformed_.N.col(i) = (cofactors(gradient(rest_.V.col(i))) * rest_.N.col(i)).stableNormalized();
  }
  return true;
}

}  // namespace deformlab
