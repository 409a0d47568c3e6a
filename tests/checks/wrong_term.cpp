// Each CASE is one mistake in a term. The compiler has to name it in one line (wrong_terms.sh).
#include "energies/term_energy.h"

using namespace deformlab;

struct Term {
#if CASE != 1  // the name is missing
  static constexpr std::string_view kName = "term";
#endif
#if CASE == 2  // the scalar is not a template parameter
  Eigen::Vector3d operator()(const Eigen::Matrix3d& R) const { return R.col(0); }
#elif CASE == 3  // the operator is not const
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) {
    return R.col(0);
  }
#elif CASE == 4  // an Eigen expression is returned
  template <class T>
  auto operator()(const Matrix<T, 3>& R) const {
    return R.col(0) - R.col(1);
  }
#elif CASE == 5  // the size of the residual is not fixed
  template <class T>
  Eigen::Matrix<T, Eigen::Dynamic, 1> operator()(const Matrix<T, 3>& R) const {
    return R.col(0);
  }
#elif CASE == 6  // the argument is no node
  template <class T>
  Vector<T, 1> operator()(const T& x) const {
    return Vector<T, 1>(x);
  }
#elif CASE == 7  // there are too many residuals
  template <class T>
  Vector<T, 17> operator()(const Matrix<T, 3>&) const {
    return Vector<T, 17>::Zero();
  }
#elif CASE == 8  // one residual cannot be Kronecker in three dimensions
  static constexpr Structure kStructure = Structure::kKronecker;
  template <class T>
  Vector<T, 1> operator()(const Matrix<T, 3>& R) const {
    return Vector<T, 1>(R(0, 0));
  }
#elif CASE == 9  // the residual has no derivative
  template <class T>
  Eigen::Vector3d operator()(const Matrix<T, 3>& R) const {
    return R.col(0);
  }
#else
  template <class T>
  Vector<T, 3> operator()(const Matrix<T, 3>& R) const {
    return R.col(0);
  }
#endif
};

int main() {
  Terms<Term> sum;
  sum.add({}, {0});
  return to_energy(sum)->size();
}
