#pragma once

#include <string>

#include "drawing/bitmap/bitmap.h"
#include "tests/support/program.h"

namespace deformlab::test {

/// Holds one end of `bar` and lowers the other one.
inline constexpr const char* kEdit =
    "edit:\n"
    "  - {select: {point: [15, 40]}, fix: true}\n"
    "  - {select: {point: [105, 40]}, by: [0, 20]}\n";

/// A bar from (10, 25) to (110, 55) on a page of 120 × 80 pixels, its right half blue.
inline Bitmap bar() {
  Bitmap bitmap(120, 80);
  for (int y = 25; y < 55; ++y) {
    for (int x = 10; x < 110; ++x) {
      std::uint8_t* p = bitmap.pixel(x, y);
      p[0] = x < 60 ? 220 : 30;
      p[1] = 60;
      p[2] = x < 60 ? 30 : 220;
      p[3] = 255;
    }
  }
  return bitmap;
}

/// A program with drawings to work on.
class DrawingProgram : public Program {
 protected:
  void put_bitmap(const std::string& name, const Bitmap& bitmap) const {
    write_png(bitmap, place(name));
  }
  void put_svg(const std::string& name, const std::string& body) const {
    put(name, "<svg xmlns='http://www.w3.org/2000/svg' width='120' height='80'>" + body + "</svg>");
  }
};

}  // namespace deformlab::test
