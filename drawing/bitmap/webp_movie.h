#pragma once

#include <memory>
#include <string>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// An animated WebP that is made frame by frame. Its pixels are exactly those of the frames (it is
/// lossless), with their alpha. The same frames give the same bytes.
class WebpMovie {
 public:
  static constexpr int kLargestSide = 16383;  ///< [pixel]

  /// All frames have this size [pixel]. `loop` says how often the movie is played; 0: for ever.
  /// Throws InputError for a side that the format does not have.
  WebpMovie(int width, int height, double fps, int loop);
  ~WebpMovie();
  WebpMovie(WebpMovie&&) noexcept;
  WebpMovie& operator=(WebpMovie&&) noexcept;

  /// Adds a frame. Throws InputError where there is not enough memory for it.
  void add(const Bitmap& frame);
  /// The bytes of the file. No frame can be added after this.
  std::string finish();

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace deformlab
