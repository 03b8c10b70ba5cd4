#include "runs/drawing/line_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

std::size_t pixels_of(const testing::DecodedPng& picture, Colour colour) {
  std::size_t count = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) count += picture.at(x, y) == colour;
  }
  return count;
}

constexpr Colour kRed{255, 0, 0}, kBlue{0, 0, 255};

ChartPanel panel() {
  return {
      "x [s]", "y [nm]", {{"red", kRed, {{1.0, 1.0, false}, {10.0, 2.0, true}}}, {"blue", kBlue, {{3.0, 5.0, false}}}}};
}

TEST(LineCharts, LinearAxesAreLinearAndCutLinesWhereThereIsNoValue) {
  const double nan = std::nan("");
  ChartPanel linear{"x",
                    "y",
                    {{"", kRed, {{-2.0, -1.0}, {0.0, 0.0}, {1.0, nan}, {2.0, 1.0}}, true}},
                    AxisScale::Linear,
                    AxisScale::Linear};
  const auto picture = testing::decode_png(draw_line_charts("", "", {linear}));
  // The middle of three dots evenly apart: its centre is the mean of the other two.
  int first_x = picture.width, last_x = 0, first_y = picture.height, last_y = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!(picture.at(x, y) == kRed)) continue;
      first_x = std::min(first_x, x), last_x = std::max(last_x, x);
      first_y = std::min(first_y, y), last_y = std::max(last_y, y);
    }
  }
  const int middle_x = (first_x + last_x) / 2, middle_y = (first_y + last_y) / 2;
  const auto red_near = [&](int x, int y) {  // within the thickness of a line
    bool red = false;
    for (int d = -2; d <= 2; ++d) red = red || picture.at(x, y + d) == kRed;
    return red;
  };
  EXPECT_TRUE(red_near(middle_x, middle_y));
  EXPECT_TRUE(red_near((3 * first_x + last_x) / 4, (first_y + 3 * last_y) / 4));   // the line to the first
  EXPECT_FALSE(red_near((first_x + 3 * last_x) / 4, (3 * first_y + last_y) / 4));  // none to the last
}

TEST(LineCharts, DashedLinesAreHalfAsLongAndBandsAreShaded) {
  ChartPanel solid{"x", "y", {{"", kRed, {{1.0, 1.0}, {10.0, 10.0}}, false}}}, dashed = solid;
  dashed.lines[0].dashed = true;
  dashed.bands = {{"band", 0.0, 3.0, kBlue}};
  const auto a = testing::decode_png(draw_line_charts("", "", {solid}));
  const auto b = testing::decode_png(draw_line_charts("", "", {dashed}));
  const double share = static_cast<double>(pixels_of(b, kRed)) / static_cast<double>(pixels_of(a, kRed));
  EXPECT_NEAR(share, 0.5, 0.12);
  EXPECT_EQ(pixels_of(a, kBlue), 0u);
  EXPECT_GT(pixels_of(b, kBlue), 1600u * 540u / 4u);
}

TEST(LineCharts, DrawEveryLineInEveryPanelAndMarkPoints) {
  const auto one = testing::decode_png(draw_line_charts("title", "marked", {panel()}));
  const auto two = testing::decode_png(draw_line_charts("title", "marked", {panel(), panel()}));
  ChartPanel unmarked = panel();
  unmarked.lines[0].points[1].marked = false;
  const auto plain = testing::decode_png(draw_line_charts("title", "marked", {unmarked}));
  EXPECT_GT(pixels_of(one, kRed), pixels_of(plain, kRed));
  // The blue point alone, of a radius of six pixels, and its line in the key, 36 pixels long.
  const auto disc = static_cast<double>(pixels_of(two, kBlue) - pixels_of(one, kBlue));
  EXPECT_NEAR(disc, 3.1416 * 36.0, 25.0);
  EXPECT_NEAR(static_cast<double>(pixels_of(one, kBlue)) - disc, 36.0 * 5.0, 50.0);
}

TEST(LineCharts, AreNoWiderThanTheWidestSheetAndHoldTheirWords) {
  ChartPanel named = panel();
  named.title = "a & b";
  named.bands = {{"form 3 nm", 1.0, 10.0, {244, 246, 232}}};
  const std::vector<ChartPanel> panels{named, panel(), panel()};
  const auto png = testing::decode_png(draw_line_charts(std::string(300, 'W'), "marked", panels));
  EXPECT_LE(png.width, 1600);
  EXPECT_GT(png.height, 1200) << "the third panel stands below the first";
  const std::string svg = draw_line_charts("A title", "marked", panels, FigureFormat::Svg);
  for (const char* words :
       {">A title<", ">x [s]<", ">y [nm]<", ">red<", ">blue<", ">marked<", ">a &amp; b<", ">form 3 nm<"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
}

TEST(LineCharts, StepsGoAcrossBeforeTheyGoUp) {
  ChartPanel steps{"x", "y", {{"", kRed, {{0.0, 0.0}, {1.0, 1.0}}, false}}, AxisScale::Linear, AxisScale::Linear};
  const std::size_t straight = pixels_of(testing::decode_png(draw_line_charts("", "", {steps})), kRed);
  steps.lines[0].steps = true;
  EXPECT_GT(pixels_of(testing::decode_png(draw_line_charts("", "", {steps})), kRed), straight + straight / 8);
}

TEST(LineCharts, TakeTheLimitsOfAnAxisThatAreGiven) {
  ChartPanel given = panel();
  given.y_limits = ChartLimits{1e-4, 1e4};
  const std::string svg = draw_line_charts("", "", {given}, FigureFormat::Svg);
  EXPECT_NE(svg.find(">0.01<"), std::string::npos);
  EXPECT_EQ(draw_line_charts("", "", {panel()}, FigureFormat::Svg).find(">0.01<"), std::string::npos);
}

TEST(LineCharts, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(draw_line_charts("title", "marked", {panel()}), draw_line_charts("title", "marked", {panel()}));
}

TEST(LineCharts, ValuesThatAreNotPositiveDoNoHarm) {
  ChartPanel odd = panel();
  odd.lines[0].points = {{0.0, 1.0, true}, {std::nan(""), 0.0, false}, {5.0, -1.0, false}};
  EXPECT_GT(pixels_of(testing::decode_png(draw_line_charts("", "", {odd})), kRed), 0u);
  odd.lines = {{"", kRed, {{0.0, 0.0, false}}}};
  EXPECT_GT(pixels_of(testing::decode_png(draw_line_charts("", "", {odd})), kRed), 0u);
  EXPECT_NO_THROW(draw_line_charts("", "", {}));
}

// Two paths that leave and take the same are two points in one another, not one.
TEST(LineCharts, PointsThatLieOneOverTheOtherAreAllSeen) {
  ChartPanel same{
      "x", "y", {{"red", kRed, {{2.0, 3.0}}}, {"blue", kBlue, {{2.0, 3.0}}}, {"far", {0, 120, 0}, {{9.0, 4.0}}}}};
  const auto picture = testing::decode_png(draw_line_charts("", "", {same}));
  ChartPanel apart = same;
  apart.lines[0].points[0] = {1.0, 3.0};
  const auto other = testing::decode_png(draw_line_charts("", "", {apart}));
  EXPECT_GE(pixels_of(picture, kRed), pixels_of(other, kRed));
  EXPECT_EQ(pixels_of(picture, kBlue), pixels_of(other, kBlue));
}

}  // namespace
}  // namespace dwell
