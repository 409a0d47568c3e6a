#include "solvers/node_squares.h"

#include <algorithm>

#include "geometry/clones.h"
#include "geometry/four.h"

namespace deformlab {
namespace {

template <int d, int width>
inline __attribute__((always_inline)) void multiply(const int* rank, const double* value,
                                                    std::ptrdiff_t blocks, const double* p,
                                                    double* Hp) {
  for (std::ptrdiff_t b = 0; b < blocks; ++b, rank += width) {
    Four sum[width] = {};
    for (int q = 0; q < width; ++q) {
      const double* x = p + 4 * std::ptrdiff_t(rank[q]);
      for (int i = 0; i < d; ++i, value += 4 * width) {
        for (int c = 0; c < width; ++c) sum[c] += x[i] * four(value + 4 * c);
      }
    }
    for (int c = 0; c < width; ++c) four(Hp + 4 * std::ptrdiff_t(rank[c])) += sum[c];
  }
}

// The sizes of graphs in space and in the plane.
DEFORMLAB_CLONES
void multiply_3_3(const int* rank, const double* value, std::ptrdiff_t blocks, const double* p,
                  double* Hp) {
  multiply<3, 3>(rank, value, blocks, p, Hp);
}
DEFORMLAB_CLONES
void multiply_2_2(const int* rank, const double* value, std::ptrdiff_t blocks, const double* p,
                  double* Hp) {
  multiply<2, 2>(rank, value, blocks, p, Hp);
}

void multiply_any(int d, int width, const int* rank, const double* value, std::ptrdiff_t blocks,
                  const double* p, double* Hp) {
  for (std::ptrdiff_t b = 0; b < blocks; ++b, rank += width) {
    for (int q = 0; q < width; ++q) {
      for (int i = 0; i < d; ++i) {
        for (int c = 0; c < width; ++c, value += 4) {
          four(Hp + 4 * std::ptrdiff_t(rank[c])) +=
              p[4 * std::ptrdiff_t(rank[q]) + i] * four(value);
        }
      }
    }
  }
}

}  // namespace

void NodeSquares::compile(const Stage& stage, const Linearization& linearization) {
  dimension_ = linearization.dimension();
  width_ = 0;
  rank_.clear();
  block_of_.assign(stage.x.nodes(), -1);
  std::vector<char> read(stage.x.nodes(), 0);
  for (const auto& part : linearization.parts()) {
    if (!part.square()) continue;
    width_ = std::max(width_, part.energy->argument(0).count);
    for (const int j : part.energy->nodes()) read[j] = 1;
  }
  // A node may have fewer columns than another one's term reads: then its last stands in, times 0.
  for (int j = 0; j < stage.x.nodes(); ++j) {
    if (!read[j] || linearization.rank()[stage.x.first[j]] < 0) continue;
    block_of_[j] = static_cast<int>(rank_.size()) / width_;
    for (int c = 0; c < width_; ++c) {
      const int column = std::min(stage.x.first[j] + c, stage.x.first[j + 1] - 1);
      rank_.push_back(linearization.rank()[column]);
    }
  }
  values_.assign(rank_.size() * dimension_ * 4 * width_, 0);
}

void NodeSquares::sum(const Linearization& linearization) {
  const int d = dimension_, stride = d * 4 * width_ * width_;
  std::fill(values_.begin(), values_.end(), 0);
  for (const auto& part : linearization.parts()) {
    if (!part.square()) continue;
    const int count = part.energy->argument(0).count, n = d * count;
    const double* JtJ = part.JtJ.data();
    for (const int j : part.energy->nodes()) {
      double* block = values_.data() + std::ptrdiff_t(block_of_[j]) * stride;
      for (int q = 0; q < n; ++q, JtJ += n) {
        for (int c = 0; c < count && block_of_[j] >= 0; ++c) {
          for (int i = 0; i < d; ++i) {
            block[(q * width_ + c) * 4 + i] += part.weight * JtJ[c * d + i];
          }
        }
      }
    }
  }
}

void NodeSquares::add_product(const Columns4& p, Columns4& Hp) const {
  if (width_ == 0) return;
  const std::ptrdiff_t blocks = std::ssize(rank_) / width_;
  if (dimension_ == 3 && width_ == 3) {
    multiply_3_3(rank_.data(), values_.data(), blocks, p.data(), Hp.data());
  } else if (dimension_ == 2 && width_ == 2) {
    multiply_2_2(rank_.data(), values_.data(), blocks, p.data(), Hp.data());
  } else {
    multiply_any(dimension_, width_, rank_.data(), values_.data(), blocks, p.data(), Hp.data());
  }
}

}  // namespace deformlab
