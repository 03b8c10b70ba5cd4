#include "runs/drawing/sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "runs/drawing/sheet_files.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

constexpr Colour kBrick{200, 10, 20};

int count(const testing::DecodedPng& png, Colour colour) {
  int found = 0;
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) found += png.at(x, y) == colour ? 1 : 0;
  }
  return found;
}

TEST(Sheet, HasTwoPixelsAUnitAndDrawsWhereItIsTold) {
  Sheet sheet(FigureFormat::Png, 30.0, 20.0);
  sheet.fill({10.0, 5.0, 4.0, 3.0}, kBrick);
  const testing::DecodedPng png = testing::decode_png(sheet.bytes());
  ASSERT_EQ(png.width, 60);
  ASSERT_EQ(png.height, 40);
  EXPECT_EQ(count(png, kBrick), 8 * 6);
  EXPECT_EQ(png.at(20, 10), kBrick);
  EXPECT_EQ(png.at(27, 15), kBrick);
  EXPECT_EQ(png.at(19, 10), kPaper);
  EXPECT_EQ(png.at(28, 15), kPaper);
}

TEST(Sheet, ShowsEachPixelOfARasterOfItsSize) {
  Raster raster{6, 4, {}};
  for (std::uint32_t i = 0; i < 24; ++i) raster.pixels.push_back(packed({static_cast<std::uint8_t>(10 * i), 77, 5}));
  Sheet sheet(FigureFormat::Png, 10.0, 10.0);
  sheet.image({2.0, 3.0, 3.0, 2.0}, raster);
  const testing::DecodedPng png = testing::decode_png(sheet.bytes());
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      EXPECT_EQ(png.at(4 + x, 6 + y), (Colour{static_cast<std::uint8_t>(10 * (6 * y + x)), 77, 5})) << x << ", " << y;
    }
  }
}

TEST(Sheet, WhatLiesOutsideOfAClipDoesNotShow) {
  Sheet sheet(FigureFormat::Png, 20.0, 20.0);
  sheet.clip({5.0, 5.0, 5.0, 5.0});
  sheet.fill({0.0, 0.0, 20.0, 20.0}, kBrick);
  sheet.unclip();
  const testing::DecodedPng png = testing::decode_png(sheet.bytes());
  EXPECT_EQ(count(png, kBrick), 100);
}

TEST(Sheet, AnchorsTextAndTurnsIt) {
  const auto mean_of_ink = [](TextStyle style) {
    Sheet sheet(FigureFormat::Png, 200.0, 200.0);
    sheet.text({100.0, 100.0}, "mmmmmm", style);
    const testing::DecodedPng png = testing::decode_png(sheet.bytes());
    Point mean;
    int inked = 0;
    for (int y = 0; y < png.height; ++y) {
      for (int x = 0; x < png.width; ++x) {
        if (png.at(x, y) == kPaper) continue;
        mean = mean + Point{0.5 * x, 0.5 * y};
        ++inked;
      }
    }
    EXPECT_GT(inked, 100);
    return Point{mean.x / inked, mean.y / inked};
  };
  TextStyle style{10.0};
  const double half = 0.5 * Sheet::text_width("mmmmmm", style);
  EXPECT_NEAR(mean_of_ink(style).x, 100.0 + half, 2.0);
  EXPECT_LT(mean_of_ink(style).y, 100.0);
  style.anchor = TextStyle::Anchor::Middle;
  EXPECT_NEAR(mean_of_ink(style).x, 100.0, 2.0);
  style.anchor = TextStyle::Anchor::Right;
  EXPECT_NEAR(mean_of_ink(style).x, 100.0 - half, 2.0);
  style.upwards = true;
  EXPECT_NEAR(mean_of_ink(style).y, 100.0 + half, 2.0);
  EXPECT_LT(mean_of_ink(style).x, 100.0);
}

TEST(Sheet, WritesTheSameBytesWithoutTimeWhateverWasDrawnBefore) {
  const auto drawn = [](FigureFormat format) {
    Sheet sheet(format, 50.0, 50.0);
    sheet.text({5.0, 20.0}, "text", {});
    sheet.image({10.0, 30.0, 10.0, 10.0}, {1, 2, {0xff0000, 0x00ff00}});
    sheet.clip({0.0, 0.0, 9.0, 9.0});
    sheet.line({1.0, 1.0}, {20.0, 20.0}, {kBrick, 2.0, true});
    sheet.unclip();
    return sheet.bytes();
  };
  for (const FigureFormat format : figure_formats()) {
    const std::string first = drawn(format);
    drawn(FigureFormat::Svg);
    EXPECT_EQ(first, drawn(format)) << to_string(format);
    for (const char* chunk : {"tIME", "tEXt", "iTXt", "zTXt"}) EXPECT_EQ(first.find(chunk), std::string::npos) << chunk;
  }
  EXPECT_NE(drawn(FigureFormat::Pdf).find("19700101"), std::string::npos);
}

TEST(Sheet, TakesAnyTextAndStillDrawsWhatFollows) {
  EXPECT_EQ(printable_utf8("a\xff\xc3(b\n\xc2\xb2\xe2\x82"), "a\?\?(b \xc2\xb2??");
  EXPECT_EQ(printable_utf8("\xed\xa0\x80\xf4\x90\x80\x80\xc0\xaf"), "?????????");
  Sheet sheet(FigureFormat::Svg, 50.0, 50.0);
  sheet.text({5.0, 20.0}, "\xff", {});
  sheet.text({5.0, 20.0}, "", {});
  sheet.text({5.0, 30.0}, "after", {});
  EXPECT_NE(sheet.bytes().find(">after<"), std::string::npos);
}

TEST(Sheet, BreaksTextAtSpacesOrWithinWords) {
  const TextStyle style{10.0};
  const double room = Sheet::text_width("two words", style) + 0.5;
  EXPECT_EQ(break_into_lines("two words more", style, room), (std::vector<std::string>{"two words", "more"}));
  EXPECT_EQ(break_into_lines("", style, room), std::vector<std::string>{});
  std::string all;
  for (const std::string& line : break_into_lines(std::string(60, 'W'), style, room)) {
    EXPECT_LE(Sheet::text_width(line, style), room);
    all += line;
  }
  EXPECT_EQ(all, std::string(60, 'W'));
  EXPECT_EQ(break_into_lines("\xc2\xb2\xc2\xb2", style, 1.0), (std::vector<std::string>{"\xc2\xb2", "\xc2\xb2"}));
}

TEST(Sheet, RefusesSizesThatAreNone) {
  EXPECT_THROW(Sheet(FigureFormat::Png, 0.0, 10.0), std::invalid_argument);
  EXPECT_THROW(Sheet(FigureFormat::Png, 10.0, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
