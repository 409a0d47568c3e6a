#pragma once

namespace deformlab {

/// While it lives, OpenMP starts no threads from this one. CHOLMOD's supernodal factorization asks
/// for four in loops so short that starting them takes longer than the work, however few
/// processors there are: a step of embedded deformation takes 1.4 to 1.8 times as long with them.
class OneThread {
 public:
  /// More than one may be asked for: then nothing is held back.
  explicit OneThread(int threads = 1);
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_;
};

}  // namespace deformlab
