#include "runs/drawing/canvas.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "runs/drawing/bitmap_font.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kRed{200, 10, 20};

int pixels_of(const Canvas& canvas, Colour colour) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == colour ? 1 : 0;
  }
  return count;
}

TEST(Canvas, PngDecodesToTheSamePixels) {
  Canvas canvas(7, 5, kWhite);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      canvas.set(x, y, {static_cast<std::uint8_t>(31 * x), static_cast<std::uint8_t>(50 * y), 77});
    }
  }
  const testing::DecodedPng png = testing::decode_png(canvas.png());
  ASSERT_EQ(png.width, 7);
  ASSERT_EQ(png.height, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) EXPECT_EQ(png.at(x, y), canvas.pixel(x, y)) << x << ", " << y;
  }
}

TEST(Canvas, PngCarriesNeitherTimeNorText) {
  const std::string png = Canvas(3, 3, kRed).png();
  for (const char* chunk : {"tIME", "tEXt", "iTXt", "zTXt"}) EXPECT_EQ(png.find(chunk), std::string::npos) << chunk;
  EXPECT_EQ(png, Canvas(3, 3, kRed).png());
}

TEST(Canvas, DrawsNothingOutside) {
  Canvas canvas(4, 3, kWhite);
  canvas.fill_rectangle(2, 1, 100, 100, kRed);
  canvas.fill_rectangle(-5, -5, 6, 6, kRed);
  canvas.set(4, 0, kRed);
  canvas.set(0, -1, kRed);
  EXPECT_EQ(pixels_of(canvas, kRed), 2 * 2 + 1);
  EXPECT_THROW(canvas.pixel(4, 0), std::out_of_range);
  EXPECT_THROW(Canvas(0, 3, kWhite), std::invalid_argument);
}

TEST(Canvas, LineJoinsItsEndsWithoutGaps) {
  for (const auto& [x1, y1] : {std::pair{9, 3}, std::pair{-9, 3}, std::pair{4, -9}, std::pair{0, 8}}) {
    Canvas canvas(21, 21, kWhite);
    canvas.line(10, 10, 10 + x1, 10 + y1, kRed);
    EXPECT_EQ(canvas.pixel(10, 10), kRed);
    EXPECT_EQ(canvas.pixel(10 + x1, 10 + y1), kRed);
    EXPECT_EQ(pixels_of(canvas, kRed), std::max(std::abs(x1), std::abs(y1)) + 1);
  }
}

TEST(Canvas, TextScalesAndTurns) {
  const std::string text = "gL";
  const int width = Canvas::text_width(text, 2);
  EXPECT_EQ(width, 2 * (kGlyphAdvance + kGlyphWidth));
  Canvas small(20, 12, kWhite);
  Canvas large(40, 24, kWhite);
  Canvas turned(24, 40, kWhite);
  small.text(1, 1, text, 1, kRed);
  large.text(2, 2, text, 2, kRed);
  turned.text_upwards(2, 38, text, 2, kRed);
  ASSERT_GT(pixels_of(small, kRed), 10);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(large.pixel(x, y), small.pixel(x / 2, y / 2));
      EXPECT_EQ(turned.pixel(y, 39 - x), large.pixel(x, y));  // a quarter turn anticlockwise
    }
  }
}

TEST(BitmapFont, EveryPrintableCharacterIsDrawnAndDiffers) {
  std::set<std::pair<std::array<std::uint8_t, 7>, int>> seen;
  for (char c = ' '; c <= '~'; ++c) {
    const Glyph glyph = glyph_of(c);
    for (const auto row : glyph.rows) EXPECT_LT(row, 32) << c;
    EXPECT_TRUE(seen.insert({glyph.rows, glyph.drop}).second) << "'" << c << "' looks like another";
  }
  EXPECT_TRUE(seen.insert({glyph_of('\n').rows, 0}).second) << "the box for unknown characters is its own sign";
}

TEST(BitmapFont, CountsCodePointsNotBytes) {
  EXPECT_EQ(drawn_characters("nm"), 2);
  EXPECT_EQ(drawn_characters("\xC2\xB5m"), 2);  // micro sign in UTF-8, m
  EXPECT_EQ(Canvas::text_width("", 2), 0);
}

}  // namespace
}  // namespace dwell
