#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>
#include <zlib.h>

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

/// EXIF data that give an orientation, as they begin with the header of a TIFF.
std::string tiff(char orientation) {
  using namespace std::string_literals;
  return "MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0"s + orientation + "\0\0\0\0\0\0"s;
}

/// The JPEG with a segment in front.
std::string with_segment(const std::string& jpeg, char marker, const std::string& data) {
  const std::string length{static_cast<char>((data.size() + 2) >> 8),
                           static_cast<char>(data.size() + 2)};
  return jpeg.substr(0, 2) + "\xff" + marker + length + data + jpeg.substr(2);
}

/// The JPEG with EXIF data that give an orientation.
std::string oriented(const std::string& jpeg, char orientation) {
  using namespace std::string_literals;
  return with_segment(jpeg, '\xe1', "Exif\0\0"s + tiff(orientation));
}

/// An ICC profile as far as its header goes.
std::string profile(const std::string& colors) {
  std::string bytes(400, 'p');
  return bytes.replace(16, 4, colors);
}

std::string little_endian(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
  return text;
}

/// A WebP with EXIF data and an ICC profile.
std::string webp(const Bitmap& bitmap, const std::string& exif, const std::string& icc) {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(bitmap.rgba.data(), bitmap.width, bitmap.height,
                                                  4 * bitmap.width, &bytes);
  const std::string plain(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  const auto chunk = [](const std::string& name, const std::string& data) {
    return name + little_endian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
  };
  const std::string head = little_endian(0x38, 4) + little_endian(bitmap.width - 1, 3) +
                           little_endian(bitmap.height - 1, 3);
  const std::string body =
      "WEBP" + chunk("VP8X", head) + chunk("ICCP", icc) + plain.substr(12) + chunk("EXIF", exif);
  return "RIFF" + little_endian(body.size(), 4) + body;
}

/// A chunk of a PNG.
std::string chunk(const std::string& name, const std::string& data) {
  const auto big_endian = [](std::size_t value) {
    const std::string text = little_endian(value, 4);
    return std::string(text.rbegin(), text.rend());
  };
  const std::string body = name + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return big_endian(data.size()) + body + big_endian(sum);
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

TEST_F(ImageFiles, TheOrientationOfAPngAndAWebpIsApplied) {
  using namespace std::string_literals;
  write_png(halves(), place("plain.png"));
  const std::string density = chunk("pHYs", "\0\0\0\1\0\0\0\2\1"s);
  put("a.png", with_chunks(get("plain.png"), density + chunk("eXIf", tiff(6)), 1));
  put("a.webp", webp(halves(), tiff(6), profile("RGB ")));
  put("b.webp", webp(halves(), "Exif\0\0"s + tiff(6), profile("RGB ")));
  for (const char* name : {"a.png", "a.webp", "b.webp"}) {
    const Bitmap turned = read_image(place(name)).bitmap;
    ASSERT_EQ(turned.width, 16) << name;
    EXPECT_EQ(turned.pixel(8, 4)[0], 255) << "what was on the left is at the top";
  }
  EXPECT_EQ(read_image(place("a.png")).chunks, chunk("pHYs", "\0\0\0\2\0\0\0\1\1"s));
}

TEST_F(ImageFiles, TheColourProfileOfEveryFormatIsKept) {
  using namespace std::string_literals;
  const std::string icc = profile("RGB ");
  const std::string half = icc.substr(0, 150), rest = icc.substr(150);
  // The parts of a JPEG's profile may stand in any order.
  put("a.jpg", with_segment(with_segment(jpeg(halves()), '\xe2', "ICC_PROFILE\0\1\2"s + half),
                            '\xe2', "ICC_PROFILE\0\2\2"s + rest));
  put("a.webp", webp(halves(), tiff(1), icc));
  write_png(halves(), place("plain.png"));
  put("a.png", with_chunks(get("plain.png"), profile_chunk(icc), 1));
  for (const char* name : {"a.jpg", "a.webp", "a.png"}) {
    const ReadImage image = read_image(place(name));
    EXPECT_EQ(image.chunks, profile_chunk(icc)) << name;
    write_png(image.bitmap, place("out.png"), image.chunks);
    EXPECT_EQ(profile_of_png(get("out.png")), icc) << name;
    EXPECT_THAT(get("out.png"), ::testing::Not(HasSubstr("sRGB"))) << "the profile replaces it";
  }
}

TEST_F(ImageFiles, AProfileThatDoesNotFitThePixelsIsLeftOutAndNamed) {
  using namespace std::string_literals;
  const std::string icc = profile("GRAY");
  put("a.jpg", with_segment(jpeg(halves()), '\xe2', "ICC_PROFILE\0\1\1"s + icc));
  write_png(halves(), place("plain.png"));
  put("a.png", with_chunks(get("plain.png"), profile_chunk(icc), 1));
  for (const char* name : {"a.jpg", "a.png"}) {
    const ReadImage image = read_image(place(name));
    EXPECT_EQ(image.chunks, "") << name;
    EXPECT_THAT(image.notes, ::testing::ElementsAre(HasSubstr("colour profile"))) << name;
  }
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
