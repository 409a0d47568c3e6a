#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace deformlab {

/// Room for `count` values that need not be initialized: on the stack for up to `usual` of them, so
/// that an update allocates nothing, and on the heap for more.
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
