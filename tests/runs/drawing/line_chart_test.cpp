#include "runs/drawing/line_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

TEST(LogTicks, AreOneTwoFiveOrDecadesOrRoundNumbersOfANarrowRange) {
  EXPECT_EQ(log_ticks(0.15, 2.5, 7).labels, (std::vector<std::string>{"0.2", "0.5", "1", "2"}));
  EXPECT_EQ(log_ticks(0.001, 1000.0, 7).labels,
            (std::vector<std::string>{"0.001", "0.01", "0.1", "1", "10", "100", "1000"}));
  EXPECT_EQ(log_ticks(355.0, 440.0, 5).labels, (std::vector<std::string>{"360", "380", "400", "420", "440"}));
  const Ticks narrow = log_ticks(1.0, 1.0 + 1e-6, 7);
  for (const double v : narrow.values) EXPECT_TRUE(v >= 1.0 && v <= 1.0 + 1e-6) << v;
}

TEST(LogTicks, LieWithinAnyRange) {
  for (int i = -60; i <= 60; ++i) {
    for (const double ratio : {1.001, 1.5, 2.1, 7.0, 1e3, 1e9}) {
      const double lower = std::pow(10.0, 0.17 * i), upper = lower * ratio;
      const Ticks ticks = log_ticks(lower, upper, 7);
      EXPECT_GE(ticks.values.size(), 1u);
      EXPECT_EQ(ticks.values.size(), ticks.labels.size());
      for (const double v : ticks.values) EXPECT_TRUE(v >= lower * (1 - 1e-9) && v <= upper * (1 + 1e-9)) << v;
    }
  }
}

TEST(LogTicks, RefuseWhatIsNoRange) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const auto& [lower, upper] :
       {std::pair{0.0, 1.0}, {-1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {1.0, inf}, {nan, 1.0}}) {
    EXPECT_THROW(log_ticks(lower, upper, 7), std::invalid_argument) << lower << " " << upper;
  }
  EXPECT_THROW(log_ticks(1.0, 2.0, 2), std::invalid_argument);
}

std::size_t pixels_of(const testing::DecodedPng& picture, Colour colour) {
  std::size_t count = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) count += picture.at(x, y) == colour;
  }
  return count;
}

constexpr Colour kPureRed{255, 0, 0}, kBlue{0, 0, 255};

ChartPanel panel() {
  return {"x [s]",
          "y [nm]",
          {{"red", kPureRed, {{1.0, 1.0, false}, {10.0, 2.0, true}}}, {"blue", kBlue, {{3.0, 5.0, false}}}}};
}

TEST(LineCharts, LinearAxesAreLinearAndCutLinesWhereThereIsNoValue) {
  const double nan = std::nan("");
  ChartPanel linear{"x",
                    "y",
                    {{"", kPureRed, {{-2.0, -1.0}, {0.0, 0.0}, {1.0, nan}, {2.0, 1.0}}, true}},
                    AxisScale::Linear,
                    AxisScale::Linear};
  const auto picture = testing::decode_png(draw_line_charts("", "", {linear}));
  // The middle of three dots evenly apart: its centre is the mean of the other two.
  int first_x = picture.width, last_x = 0, first_y = picture.height, last_y = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!(picture.at(x, y) == kPureRed)) continue;
      first_x = std::min(first_x, x), last_x = std::max(last_x, x);
      first_y = std::min(first_y, y), last_y = std::max(last_y, y);
    }
  }
  const int middle_x = (first_x + last_x) / 2, middle_y = (first_y + last_y) / 2;
  const auto red_near = [&](int x, int y) {  // within the thickness of a line
    bool red = false;
    for (int d = -2; d <= 2; ++d) red = red || picture.at(x, y + d) == kPureRed;
    return red;
  };
  EXPECT_TRUE(red_near(middle_x, middle_y));
  EXPECT_TRUE(red_near((3 * first_x + last_x) / 4, (first_y + 3 * last_y) / 4));   // the line to the first
  EXPECT_FALSE(red_near((first_x + 3 * last_x) / 4, (3 * first_y + last_y) / 4));  // none to the last
}

TEST(LineCharts, DashedLinesAreHalfAsLongAndBandsAreShaded) {
  ChartPanel solid{"x", "y", {{"", kPureRed, {{1.0, 1.0}, {10.0, 10.0}}, false}}}, dashed = solid;
  dashed.lines[0].dashed = true;
  dashed.bands = {{"band", 0.0, 3.0, kBlue}};
  const auto a = testing::decode_png(draw_line_charts("", "", {solid}));
  const auto b = testing::decode_png(draw_line_charts("", "", {dashed}));
  const double share = static_cast<double>(pixels_of(b, kPureRed)) / static_cast<double>(pixels_of(a, kPureRed));
  EXPECT_NEAR(share, 0.5, 0.1);
  EXPECT_EQ(pixels_of(a, kBlue), 0u);
  EXPECT_GT(pixels_of(b, kBlue), 560u * 420u / 3u);
}

TEST(LineCharts, DrawEveryLineInEveryPanelAndMarkPoints) {
  const auto one = testing::decode_png(draw_line_charts("title", "marked", {panel()}));
  const auto two = testing::decode_png(draw_line_charts("title", "marked", {panel(), panel()}));
  const std::size_t key = 24 * 4;  // of a line, once a picture
  EXPECT_EQ(pixels_of(two, kBlue) - key, 2 * (pixels_of(one, kBlue) - key));
  EXPECT_EQ(pixels_of(two, kPureRed) - key, 2 * (pixels_of(one, kPureRed) - key));
  EXPECT_EQ(pixels_of(one, kBlue), 49 + key);      // one unmarked point of 7 x 7
  EXPECT_GT(pixels_of(one, kPureRed), 121 + key);  // a marked one of 11 x 11, the line and the other point
}

TEST(LineCharts, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(draw_line_charts("title", "marked", {panel()}), draw_line_charts("title", "marked", {panel()}));
}

TEST(LineCharts, ValuesThatAreNotPositiveDoNoHarm) {
  ChartPanel odd = panel();
  odd.lines[0].points = {{0.0, 1.0, true}, {std::nan(""), 0.0, false}, {5.0, -1.0, false}};
  EXPECT_GT(pixels_of(testing::decode_png(draw_line_charts("", "", {odd})), kPureRed), 0u);
  odd.lines = {{"", kPureRed, {{0.0, 0.0, false}}}};
  EXPECT_GT(pixels_of(testing::decode_png(draw_line_charts("", "", {odd})), kPureRed), 0u);
  EXPECT_NO_THROW(draw_line_charts("", "", {}));
}

}  // namespace
}  // namespace dwell
