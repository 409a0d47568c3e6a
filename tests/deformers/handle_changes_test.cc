#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "deformers/embedded/embedded_deformation.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// Two deformers of one shape. One adapts to changes of handles. The other compiles each set of
// handles afresh, because `reset` makes it.
class Pair {
 public:
  Pair(const Shape& shape, const EmbeddedDeformationOptions& options)
      : shape_(shape), adapting_(shape, options), fresh_(shape, options) {}

  // The targets are at `lift` above the vertices, each with its own factor.
  double apart(const Handles& handles, const Eigen::VectorXd& lift) {
    adapting_.compile(handles);
    fresh_.reset();
    fresh_.compile(handles);
    Eigen::Matrix3Xd targets = shape_.V(Eigen::all, handles.moved);
    for (Eigen::Index l = 0; l < targets.cols(); ++l) targets(2, l) += lift[handles.moved[l]];
    fresh_.begin_at(adapting_.transformations());
    adapting_.update(targets);
    fresh_.update(targets);
    return (adapting_.deformed().V - fresh_.deformed().V).cwiseAbs().maxCoeff();
  }
  void adapt(const Handles& handles) { adapting_.compile(handles); }
  int compilations() const { return adapting_.compilations(); }

 private:
  Shape shape_;
  EmbeddedDeformation adapting_, fresh_;
};

// Adds, removes, moves, fixes and frees handles at random. There are always some of each kind, so
// that the minimum is well determined.
class RandomEdits {
 public:
  explicit RandomEdits(int vertices) : vertices_(vertices), lift_(Eigen::VectorXd::Zero(vertices)) {
    for (int i = 0; i < kFewest; ++i)
      handles_.fixed.push_back(i), handles_.moved.push_back(last() - i);
  }

  void next() {
    const int kind = below(20);
    std::vector<int>& moved = handles_.moved;
    if (kind == 0 || std::ssize(handles_.fixed) < kFewest) {
      fix(below(vertices_));
    } else if (kind == 1) {
      handles_.fixed.erase(handles_.fixed.begin() + below(std::ssize(handles_.fixed)));
    } else if (kind < 9 || std::ssize(moved) < kFewest) {
      add(below(vertices_));
    } else if (kind < 15) {
      moved.erase(moved.begin() + below(std::ssize(moved)));
    }
    lift_[moved[below(std::ssize(moved))]] = 0.003 * below(10);
  }

  const Handles& handles() const { return handles_; }
  const Eigen::VectorXd& lift() const { return lift_; }

 private:
  static constexpr int kFewest = 12;

  int below(std::ptrdiff_t n) { return static_cast<int>(random_() % n); }
  int last() const { return vertices_ - 1; }
  bool is_free(int v) const {
    return !std::ranges::count(handles_.fixed, v) && !std::ranges::count(handles_.moved, v);
  }
  void add(int v) {
    if (!is_free(v)) return;
    handles_.moved.insert(handles_.moved.begin() + below(std::ssize(handles_.moved) + 1), v);
  }
  void fix(int v) {
    if (is_free(v)) handles_.fixed.insert(std::ranges::upper_bound(handles_.fixed, v), v);
  }

  std::mt19937 random_{1};
  int vertices_;
  Handles handles_;
  Eigen::VectorXd lift_;
};

// The solves go on for as long as rounding lets them, so that both end at the minimum. The targets
// are near, because where residuals are large, full steps overshoot by less than F is rounded.
EmbeddedDeformationOptions exact(int nodes) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  options.solver.linear_solver = "kronecker_cg";
  options.solver.epsilon = 1e-24;
  options.solver.max_iterations = 100;
  return options;
}

void compare(const Shape& shape, int nodes, int edits) {
  Pair pair(shape, exact(nodes));
  RandomEdits random(static_cast<int>(shape.V.cols()));
  for (int edit = 1; edit <= edits; ++edit) {
    random.next();
    if (edit % 5 != 0) {
      pair.adapt(random.handles());
    } else {
      ASSERT_LE(pair.apart(random.handles(), random.lift()), 1e-9) << edit;
    }
  }
  EXPECT_LT(pair.compilations(), edits / 3);
}

#ifdef DEFORMLAB_SANITIZED
constexpr int kEdits = 100;  // these take ten times as long
#else
constexpr int kEdits = 1000;
#endif

TEST(HandleChanges, GiveTheResultOfAFullCompilationOnAPlane) {
  compare(bumpy_plane(15), 40, kEdits);
}
TEST(HandleChanges, GiveTheResultOfAFullCompilationOnATube) { compare(tube(12), 40, kEdits); }
TEST(HandleChanges, GiveTheResultOfAFullCompilationOnPoints) {
  compare(point_set(200), 40, kEdits);
}

}  // namespace
}  // namespace deformlab::test
