#include "runs/drawing/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/errors.h"

namespace dwell {
namespace {

const double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Relative luminance of ITU-R BT.709 for sRGB values, to which lightness is monotonic.
double luminance(Colour c) {
  const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
  return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
}

TEST(ColourMap, SequentialGetsLighterAllTheWay) {
  for (int i = 1; i <= 50; ++i) {
    EXPECT_GT(luminance(colour_at(ColourMap::Sequential, i / 50.0)),
              luminance(colour_at(ColourMap::Sequential, (i - 1) / 50.0)));
  }
}

TEST(ColourMap, DivergingIsBlueBelowWhiteAtAndRedAboveTheMiddle) {
  const Colour low = colour_at(ColourMap::Diverging, 0.1);
  const Colour middle = colour_at(ColourMap::Diverging, 0.5);
  const Colour high = colour_at(ColourMap::Diverging, 0.9);
  EXPECT_GT(low.blue, low.red + 50);
  EXPECT_GT(high.red, high.blue + 50);
  EXPECT_NEAR(middle.red, middle.blue, 10);
  EXPECT_GT(middle.green, 220);
  for (int i = 1; i <= 25; ++i) {
    EXPECT_GT(luminance(colour_at(ColourMap::Diverging, i / 50.0)),
              luminance(colour_at(ColourMap::Diverging, (i - 1) / 50.0)));
    EXPECT_GT(luminance(colour_at(ColourMap::Diverging, 1.0 - i / 50.0)),
              luminance(colour_at(ColourMap::Diverging, 1.0 - (i - 1) / 50.0)));
  }
}

// Lightness of CIE L*a*b*, white = 100.
double lightness(Colour c) {
  const auto linear = [](std::uint8_t v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  return 116.0 * std::cbrt(0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue)) - 16.0;
}

TEST(ColourMap, DivergingIsEquallyLightAtEqualDistancesFromTheMiddleInEqualSteps) {
  for (int i = 0; i <= 7; ++i) {
    const double low = lightness(colour_at(ColourMap::Diverging, i / 16.0));
    EXPECT_NEAR(low, lightness(colour_at(ColourMap::Diverging, 1.0 - i / 16.0)), 0.5) << i;
    EXPECT_NEAR(low, 20.0 + 9.35 * i, 1.0) << i;
  }
}

TEST(ColourMap, ClampsAndShowsNoDataInGrey) {
  EXPECT_EQ(colour_at(ColourMap::Sequential, -3.0), colour_at(ColourMap::Sequential, 0.0));
  EXPECT_EQ(colour_at(ColourMap::Sequential, 7.0), colour_at(ColourMap::Sequential, 1.0));
  EXPECT_EQ(colour_at(ColourMap::Diverging, kNoNumber), kNoDataColour);
}

TEST(ColourLimits, DivergingShowsTheFullRangeAboutZero) {
  const ColourLimits limits = colour_limits({-3.0, kNoNumber, 1.0, 2.0}, ColourMap::Diverging);
  EXPECT_EQ(limits.lower, -3.0);
  EXPECT_EQ(limits.upper, 3.0);
  EXPECT_FALSE(limits.clips_below() || limits.clips_above());
}

TEST(ColourLimits, ASpikeDoesNotBleachTheMap) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 21) - 10.0;
  values[17] = 5000.0;
  const ColourLimits diverging = colour_limits(values, ColourMap::Diverging);
  EXPECT_EQ(diverging.upper, 15.0);  // 1.5 times the 99.5 % quantile of |v|
  EXPECT_EQ(diverging.lower, -15.0);
  EXPECT_EQ(diverging.largest, 5000.0);
  EXPECT_TRUE(diverging.clips_above());
  EXPECT_FALSE(diverging.clips_below());
  const ColourLimits sequential = colour_limits(values, ColourMap::Sequential);
  EXPECT_EQ(sequential.lower, -10.0);
  EXPECT_EQ(sequential.upper, 20.0);  // 10 and half of the 20 between the quantiles
}

TEST(ColourLimits, OneValueNoneAndZeroStillMakeARange) {
  for (const ColourMap map : {ColourMap::Sequential, ColourMap::Diverging}) {
    for (const std::vector<double>& values : {std::vector<double>{}, std::vector<double>{kNoNumber},
                                              std::vector<double>{0.0}, std::vector<double>{-4.0, -4.0}}) {
      const ColourLimits limits = colour_limits(values, map);
      EXPECT_LT(limits.lower, limits.upper);
      EXPECT_EQ(limits.any, !values.empty() && std::isfinite(values[0]));
    }
  }
}

TEST(ColourLimits, OfManyValuesAreNearlyThoseOfAllAndTheExtremesExact) {
  std::vector<double> values(3000000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 1001) - 500.0;
  values[1] = 1e6;
  const ColourLimits limits = colour_limits(values, ColourMap::Diverging);
  EXPECT_NEAR(limits.upper, 1.5 * 497.5, 10.0);
  EXPECT_EQ(limits.largest, 1e6);
  EXPECT_TRUE(limits.clips_above());
}

TEST(ColourLimits, ChosenForOneMapHoldForAnother) {
  const ColourLimits before = colour_limits({-100.0, 50.0}, ColourMap::Diverging);
  const ColourLimits after = same_limits(before, {-1.0, 200.0, kNoNumber});
  EXPECT_EQ(after.lower, -100.0);
  EXPECT_EQ(after.upper, 100.0);
  EXPECT_EQ(after.smallest, -1.0);
  EXPECT_TRUE(after.clips_above());
  EXPECT_FALSE(after.clips_below());
}

TEST(ColourLimits, TakesWhatIsGiven) {
  const ColourLimits both = colour_limits({0.0, 10.0}, ColourMap::Sequential, 2.0, 5.0);
  EXPECT_EQ(both.lower, 2.0);
  EXPECT_EQ(both.upper, 5.0);
  EXPECT_TRUE(both.clips_below() && both.clips_above());
  EXPECT_EQ(colour_limits({1.0}, ColourMap::Diverging, {}, 5.0).lower, -5.0);
  const ColourLimits beyond = colour_limits({1.0, 2.0}, ColourMap::Sequential, 7.0);
  EXPECT_EQ(beyond.lower, 7.0);
  EXPECT_GT(beyond.upper, 7.0);
}

TEST(ColourLimits, RejectsLimitsThatAreNone) {
  EXPECT_THROW(colour_limits({1.0}, ColourMap::Sequential, kNoNumber), InputError);
  EXPECT_THROW(colour_limits({1.0}, ColourMap::Sequential, {}, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(colour_limits({1.0}, ColourMap::Sequential, 3.0, 3.0), InputError);
  EXPECT_THROW(colour_limits({1.0}, ColourMap::Diverging, 1.0, 3.0), InputError);
  EXPECT_THROW(colour_limits({1.0}, ColourMap::Diverging, {}, -3.0), InputError);
}

}  // namespace
}  // namespace dwell
