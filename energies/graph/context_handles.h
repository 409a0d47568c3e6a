#pragma once

#include "geometry/transfer/embedding.h"

namespace deformlab {

/// The handles of a GraphContext. It notices when a term reads them, because such a term has to be
/// made again when handles are added or removed.
class ContextHandles {
 public:
  ContextHandles(const Embedding& handles) : handles_(&handles) {}  // NOLINT: converts as it reads
  operator const Embedding&() const { return read(); }
  const Embedding* operator->() const { return &read(); }
  bool were_read() const { return were_read_; }
  void forget() const { were_read_ = false; }

 private:
  const Embedding& read() const {
    were_read_ = true;
    return *handles_;
  }

  const Embedding* handles_;
  mutable bool were_read_ = false;
};

}  // namespace deformlab
