#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include "drawing/bitmap/png_chunks.h"
#include "drawing/bitmap/read_image.h"
#include "tests/support/drawings.h"

// Images of several formats, and what a PNG keeps besides its pixels.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class ImageFiles : public FolderTest {};

/// 32 × 16 pixels, of which the left half is red and the right half is blue.
Bitmap halves() {
  Bitmap bitmap(32, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      bitmap.pixel(x, y)[x < 16 ? 0 : 2] = 255;
      bitmap.pixel(x, y)[3] = 255;
    }
  }
  return bitmap;
}

std::string jpeg(const Bitmap& bitmap) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(encoder, bitmap.rgba.data(), bitmap.width, 0, bitmap.height, TJPF_RGBA, &bytes, &size,
              TJSAMP_444, 95, 0);
  const std::string result(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(encoder);
  return result;
}

/// The JPEG with EXIF data that give an orientation.
std::string oriented(const std::string& jpeg, char orientation) {
  using namespace std::string_literals;
  const std::string exif =
      "Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0"s + orientation + "\0\0\0\0\0\0"s;
  const std::string length{'\0', static_cast<char>(exif.size() + 2)};
  return jpeg.substr(0, 2) + "\xff\xe1" + length + exif + jpeg.substr(2);
}

TEST_F(ImageFiles, AJpegIsRead) {
  const Bitmap read = read_image(put("a.jpg", jpeg(halves()))).bitmap;
  ASSERT_EQ(read.width, 32);
  EXPECT_GT(read.pixel(4, 8)[0], 240);
  EXPECT_GT(read.pixel(28, 8)[2], 240);
  EXPECT_EQ(read.pixel(4, 8)[3], 255);
}

TEST_F(ImageFiles, TheOrientationOfAJpegIsApplied) {
  const Bitmap turned = read_image(put("a.jpg", oriented(jpeg(halves()), 6))).bitmap;
  ASSERT_EQ(turned.width, 16);
  ASSERT_EQ(turned.height, 32);
  EXPECT_GT(turned.pixel(8, 4)[0], 240);  // what was on the left is at the top
  const Bitmap flipped = read_image(put("b.jpg", oriented(jpeg(halves()), 2))).bitmap;
  EXPECT_GT(flipped.pixel(4, 8)[2], 240);
}

TEST_F(ImageFiles, AWebpIsRead) {
  const Bitmap bitmap = halves();
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(bitmap.rgba.data(), 32, 16, 4 * 32, &bytes);
  const auto path = put("a.webp", std::string(reinterpret_cast<const char*>(bytes), size));
  WebPFree(bytes);
  EXPECT_EQ(read_image(path).bitmap.rgba, bitmap.rgba);
}

TEST_F(ImageFiles, DamagedImagesAreRefused) {
  const std::string whole = jpeg(halves());
  const auto cut = put("cut.jpg", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refusal([&] { read_image(cut); }), HasSubstr("cut.jpg"));
  const auto webp = put("cut.webp", "RIFF....WEBPVP8 ");
  EXPECT_THAT(refusal([&] { read_image(webp); }), HasSubstr("cut.webp"));
}

TEST_F(ImageFiles, APngKeepsItsTextAndItsResolution) {
  using namespace std::string_literals;
  // 1000 pixels a metre, and a comment; each chunk has its checksum.
  const std::string resolution = "\0\0\0\11pHYs\0\0\3\350\0\0\3\350\1"s +
                                 "\xb5"
                                 "\x7b"
                                 "\x52"
                                 "\x6b";
  const std::string text = "\0\0\0\13tEXtTitle\0abcde"s + "\x20\x20\x20\x20";
  write_png(halves(), place("plain.png"));
  const std::string plain = get("plain.png");
  const std::string marked = with_chunks(plain, resolution, 1);
  EXPECT_EQ(kept_chunks(marked), resolution);
  EXPECT_EQ(kept_chunks(with_chunks(plain, text, 1)), "");  // a wrong checksum
  EXPECT_EQ(with_chunks(plain, "", 1), plain);
  put("marked.png", marked);
  EXPECT_EQ(read_image(place("marked.png")).bitmap.rgba, halves().rgba);
  const std::string doubled = kept_chunks(with_chunks(plain, resolution, 2));
  EXPECT_EQ(doubled.substr(8, 4), "\0\0\7\320"s);
}

}  // namespace
}  // namespace deformlab::test
