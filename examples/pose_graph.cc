// A pose graph in the plane: a robot drives around a square twice, and measures each of its moves
// and some earlier poses that it sees again, with noise. Which poses agree best with all
// measurements?
//
// A node is one pose, a column (x, y, θ). An element is one measurement between two of them.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "energies/term_energy.h"
#include "solvers/solver.h"

using namespace deformlab;

// An angle as the equal one in −π … π. Its derivative is 1.
template <class T>
T wrapped(const T& angle) {
  using std::floor;
  return angle - 2 * std::numbers::pi * floor((angle + std::numbers::pi) / (2 * std::numbers::pi));
}

// Pose b in the frame of pose a.
template <class T>
Vector<T, 3> relative(const Vector<T, 3>& a, const Vector<T, 3>& b) {
  using std::cos, std::sin;
  const T x = b[0] - a[0], y = b[1] - a[1], c = cos(a[2]), s = sin(a[2]);
  return {c * x + s * y, c * y - s * x, wrapped(T(b[2] - a[2]))};
}

struct Measurement {
  static constexpr std::string_view kName = "measurement";
  Eigen::Vector3d measured;  // of pose b in the frame of pose a

  template <class T>
  Vector<T, 3> operator()(const Vector<T, 3>& a, const Vector<T, 3>& b) const {
    const Vector<T, 3> r = relative(a, b) - measured.cast<T>();
    return {r[0], r[1], wrapped(r[2])};
  }
};

int main() {
  constexpr int kPoses = 80, kLap = 40;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.03);

  // The true poses: ten moves of length 1 along each side of the square.
  Eigen::Matrix3Xd truth = Eigen::Matrix3Xd::Zero(3, kPoses);
  for (int i = 1; i < kPoses; ++i) {
    const double heading = truth(2, i - 1), turn = i % 10 == 0 ? std::numbers::pi / 2 : 0;
    truth.col(i) = truth.col(i - 1) + Eigen::Vector3d(std::cos(heading), std::sin(heading), turn);
  }
  Terms<Measurement> sum;
  const auto measure = [&](int a, int b, double weight) {
    Eigen::Vector3d z = relative<double>(truth.col(a), truth.col(b));
    for (double& entry : z) entry += noise(random);
    sum.add({z}, {a, b}, weight);
    return z;
  };

  // The first guess adds up the moves, so that it drifts away from the truth.
  Eigen::Matrix3Xd guess = Eigen::Matrix3Xd::Zero(3, kPoses);
  for (int i = 1; i < kPoses; ++i) {
    const Eigen::Vector3d z = measure(i - 1, i, 1);
    const Eigen::Rotation2Dd R(guess(2, i - 1));
    guess.col(i) << guess.col(i - 1).head<2>() + R * z.head<2>(), guess(2, i - 1) + z[2];
  }
  for (int i = kLap; i < kPoses; i += 4) measure(i - kLap, i, 10);  // seen again on the second lap

  Problem problem{Unknowns::uniform(guess, kPoses), std::vector<char>(kPoses, 0), {}};
  problem.fixed[0] = 1;  // the measurements do not say where the drive began
  problem.terms.push_back({to_energy(sum)});
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    problem.x.X = guess;
    const auto solver = make_solver({.method = method, .epsilon = 1e-10});
    solver->compile(problem);
    const Summary summary = solver->solve(problem);
    fmt::print("{}: cost {:.12g} after {} steps, from {:.4g}; error of the last pose {:.3f}\n",
               name_of(method), summary.final_cost, summary.iterations.size(), summary.initial_cost,
               (problem.x.X - truth).rightCols<1>().head<2>().norm());
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}
