#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <webp/encode.h>

#include "drawing/bitmap/png_chunks.h"
#include "drawing/bitmap/read_image.h"
#include "tests/support/drawings.h"
#include "tests/support/images.h"

// Images of several formats, and what a PNG keeps besides its pixels.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class ImageFiles : public FolderTest {};

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
