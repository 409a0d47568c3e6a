#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace deformlab {

/// Memory for `count` values, which may be uninitialized. Up to `usual` values are on the stack, so
/// that an update allocates nothing. More values are on the heap.
template <class T, std::size_t usual>
class Room {
 public:
  explicit Room(std::size_t count) : many_(count > usual ? count : 0) {}
  T* data() { return many_.empty() ? few_.data() : many_.data(); }

 private:
  std::array<T, usual> few_;
  std::vector<T> many_;
};

}  // namespace deformlab
