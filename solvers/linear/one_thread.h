#pragma once

namespace deformlab {

/// As long as an object of this class exists, OpenMP starts no threads from the thread that made
/// it. CHOLMOD's supernodal factorization asks for four threads in loops so short that starting
/// them takes longer than the work, however few processors there are: with them, a step of embedded
/// deformation takes 1.4 to 1.8 times as long.
class OneThread {
 public:
  /// With more than one thread, the object does nothing.
  explicit OneThread(int threads = 1);
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_;
};

}  // namespace deformlab
