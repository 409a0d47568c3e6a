#include <gmock/gmock.h>
#include <png.h>

#include "drawing/bitmap/background.h"
#include "drawing/drawing.h"
#include "tests/support/drawings.h"

namespace deformlab {
namespace {

using test::disc;
using test::refusal;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DrawingBitmap : public test::FolderTest {
 protected:
  std::filesystem::path put_png(const Bitmap& bitmap, const std::string& name = "in.png") const {
    write_png(bitmap, place(name));
    return place(name);
  }
};

Bitmap filled(int width, int height, std::array<std::uint8_t, 4> color) {
  Bitmap bitmap(width, height);
  for (std::size_t i = 0; i < bitmap.rgba.size(); ++i) bitmap.rgba[i] = color[i % 4];
  return bitmap;
}

/// The same over an opaque ground.
Bitmap over(Bitmap bitmap, std::array<std::uint8_t, 3> ground) {
  for (std::size_t i = 0; i < bitmap.rgba.size(); i += 4) {
    const double a = bitmap.rgba[i + 3] / 255.0;
    for (std::size_t c = 0; c < 3; ++c)
      bitmap.rgba[i + c] =
          static_cast<std::uint8_t>(std::lround(a * bitmap.rgba[i + c] + (1 - a) * ground[c]));
    bitmap.rgba[i + 3] = 255;
  }
  return bitmap;
}

/// Writes rows of raw samples by libpng's long way, which knows every colour type.
void write_raw(const std::filesystem::path& path, int size, int depth, int type, bool interlaced,
               const std::vector<std::string>& rows) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, png_uint_32(size), png_uint_32(size), depth, type,
               interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[] = {{0, 0, 0}, {200, 100, 50}};
  const png_byte transparency[] = {0, 255};
  if (type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette, 2);
    png_set_tRNS(png, info, transparency, 2, nullptr);
  }
  std::vector<png_const_bytep> pointers;
  for (const std::string& row : rows)
    pointers.push_back(reinterpret_cast<png_const_bytep>(row.data()));
  png_set_rows(png, info, const_cast<png_bytepp>(pointers.data()));
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST_F(DrawingBitmap, PngComesBackAsItWasWritten) {
  const Bitmap bitmap = disc(40, 30, {20, 15}, 12);
  EXPECT_EQ(read_png(put_png(bitmap)).rgba, bitmap.rgba);
}

TEST_F(DrawingBitmap, EveryColorTypeIsRead) {
  const auto center = [&](const char* name) {
    const Bitmap bitmap = read_png(place(name));
    const std::uint8_t* p = bitmap.pixel(4, 4);
    return std::vector<int>{p[0], p[1], p[2], p[3]};
  };
  const std::string index(8, '\1'), gray(8, '\x80');
  std::string wide;
  for (int i = 0; i < 8; ++i) wide += {"\xff\xff\x80\x80\x00\x00\xff\xff", 8};
  write_raw(place("palette.png"), 8, 8, PNG_COLOR_TYPE_PALETTE, true, {8, index});
  write_raw(place("gray.png"), 8, 8, PNG_COLOR_TYPE_GRAY, false, {8, gray});
  write_raw(place("wide.png"), 8, 16, PNG_COLOR_TYPE_RGB_ALPHA, true, {8, wide});
  EXPECT_THAT(center("palette.png"), ElementsAre(200, 100, 50, 255));
  EXPECT_THAT(center("gray.png"), ElementsAre(128, 128, 128, 255));
  EXPECT_THAT(center("wide.png"), ElementsAre(255, 128, 0, 255));
}

TEST_F(DrawingBitmap, SilhouetteOfADiscIsFoundBelowAPixelsPrecision) {
  const Drawing drawing = read_drawing(put_png(disc(80, 60, {41.3, 29.6}, 20)), {});
  EXPECT_NEAR(area(drawing.region), std::numbers::pi * 400, 2);
  for (const auto& corner : drawing.region.outline.colwise())
    EXPECT_NEAR((corner - Eigen::Vector2d(41.3, 29.6)).norm(), 20, 0.1);
  EXPECT_THAT(drawing.notes, IsEmpty());
  EXPECT_EQ(drawing.page.sizes(), Eigen::Vector2d(80, 60));
}

TEST_F(DrawingBitmap, PlainBackgroundIsTakenAwayAndTheRimEstimated) {
  Bitmap drawn = disc(80, 60, {40, 30}, 20);
  for (std::size_t i = 0; i < drawn.rgba.size(); i += 4) {
    drawn.rgba[i] = 200;
    drawn.rgba[i + 1] = 30;
    drawn.rgba[i + 2] = 60;
  }
  const Drawing drawing = read_drawing(put_png(over(drawn, {250, 250, 245})), {});
  ASSERT_EQ(drawing.notes.size(), 1U);
  EXPECT_THAT(drawing.notes[0], HasSubstr("#fafaf5"));
  EXPECT_LT(test::mean_difference(*drawing.bitmap, drawn), 0.3);
  EXPECT_NEAR(area(drawing.region), std::numbers::pi * 400, 10);
}

TEST_F(DrawingBitmap, OtherPartsStay) {
  Bitmap two = disc(100, 60, {30, 30}, 20);
  const Bitmap small = disc(100, 60, {80, 30}, 10);
  for (std::size_t i = 0; i < two.rgba.size(); ++i) two.rgba[i] |= small.rgba[i];
  const Drawing drawing = read_drawing(put_png(two), {});
  EXPECT_EQ(drawing.bitmap->rgba, two.rgba);
  ASSERT_EQ(drawing.detached.size(), 1U);
  EXPECT_NEAR(area(drawing.detached[0]), std::numbers::pi * 100, 2);
  EXPECT_THAT(drawing.notes, IsEmpty());
}

TEST_F(DrawingBitmap, OtherPartsAreDroppedWithAWord) {
  DrawingOptions options;
  options.parts = DetachedParts::kDrop;
  Bitmap two = disc(100, 60, {30, 30}, 20);
  const Bitmap one = two, small = disc(100, 60, {80, 30}, 10);
  for (std::size_t i = 0; i < two.rgba.size(); ++i) two.rgba[i] |= small.rgba[i];
  const Drawing drawing = read_drawing(put_png(two), options);
  EXPECT_EQ(drawing.bitmap->rgba, one.rgba);
  ASSERT_EQ(drawing.notes.size(), 1U);
  EXPECT_THAT(drawing.notes[0], AllOf(HasSubstr("left out 1"), HasSubstr("20 %")));
}

TEST_F(DrawingBitmap, HolesStayHoles) {
  Bitmap ring = disc(60, 60, {30, 30}, 25);
  const Bitmap hole = disc(60, 60, {30, 30}, 10);
  for (std::size_t i = 0; i < ring.rgba.size(); i += 4)
    if (hole.rgba[i + 3] > 0) std::fill_n(ring.rgba.begin() + std::ptrdiff_t(i), 4, 0);
  EXPECT_EQ(read_drawing(put_png(ring), {}).region.holes.size(), 1U);
}

TEST_F(DrawingBitmap, RefusesWhatHasNoSilhouette) {
  const auto message = [&](const Bitmap& bitmap) {
    return refusal([&] { read_drawing(put_png(bitmap), {}); });
  };
  EXPECT_THAT(message(Bitmap(20, 20)), HasSubstr("in.png"));
  EXPECT_THAT(message(filled(20, 20, {9, 9, 9, 100})), HasSubstr("opaque"));
  EXPECT_THAT(message(filled(1, 1, {9, 9, 9, 255})), HasSubstr("at least 3×3"));
  EXPECT_THAT(message(filled(20, 20, {9, 9, 9, 255})), HasSubstr("opaque"));
  EXPECT_THAT(message(over(disc(30, 30, {15, 15}, 60), {0, 0, 0})),
              AllOf(HasSubstr("background is not plain"), HasSubstr("transparent")));
}

TEST_F(DrawingBitmap, RefusesDamagedFiles) {
  put_png(disc(60, 60, {30, 30}, 25));
  const std::string bytes = get("in.png");
  const auto message = [&](const std::string& cut) {
    return refusal([&] { read_drawing(put("cut.png", cut), {}); });
  };
  for (const std::size_t kept : {bytes.size() / 8, bytes.size() / 2, bytes.size() - 30})
    EXPECT_THAT(message(bytes.substr(0, kept)), HasSubstr("damaged")) << kept;
  EXPECT_THAT(message("no picture at all"), HasSubstr("cut.png"));
  EXPECT_THAT(message(""), HasSubstr("empty"));
  EXPECT_THAT(refusal([&] { read_drawing(place("none.png"), {}); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { read_drawing(place("in.gif"), {}); }), HasSubstr(".gif"));
}

TEST_F(DrawingBitmap, TwentyThousandPixelsWideWork) {
  Bitmap wide(20000, 12);
  for (int x = 5; x < 19995; ++x)
    for (int y = 3; y < 9; ++y) std::fill_n(wide.pixel(x, y), 4, 255);
  const Drawing drawing = read_drawing(put_png(wide), {});
  EXPECT_NEAR(area(drawing.region), 19990.0 * 6, 2);
}

TEST_F(DrawingBitmap, RefusesMorePixelsThanItsLimitBeforeItReadsThem) {
  put_png(disc(60, 60, {30, 30}, 25));
  std::string bytes = get("in.png");
  bytes[16] = bytes[20] = 0;  // the sides, in the first chunk
  bytes[17] = bytes[21] = 0;
  bytes[18] = bytes[22] = 0x75;
  const std::string checksum = {"\0\0\0\0", 4};
  std::uint32_t crc = 0xFFFFFFFF;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(~crc >> (24 - 8 * i));
  EXPECT_THAT(refusal([&] { read_drawing(put("huge.png", bytes), {}); }),
              AllOf(HasSubstr("30012×30012"), HasSubstr("100 million")));
}

TEST_F(DrawingBitmap, WritesNothingWhereItCannot) {
  EXPECT_THAT(refusal([&] { write_png(Bitmap(3, 3), place("none/out.png")); }),
              HasSubstr("cannot write"));
  EXPECT_FALSE(std::filesystem::exists(place("none")));
}

}  // namespace
}  // namespace deformlab
