#include "core/tif/rate_rim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tif/tif_pedestal.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/tif/measured_tool.h"

namespace dwell {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

TEST(OutsideData, IsWhatHasNoDataAndReachesTheEdge) {
  // The hole in the middle is inside: its way to the corner is barred by sides.
  const HeightMap map(Grid{4, 5, 1.0, 1.0, {}}, {kMissing, 1,        1,        1, 1,  //
                                                 kMissing, 1,        kMissing, 1, 1,  //
                                                 1,        kMissing, 1,        1, 1,  //
                                                 1,        kMissing, 1,        1, 1});
  const std::vector<char> expected{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0};
  EXPECT_EQ(outside_data(map), expected);
}

TEST(StepsFromRim, CountFromTheEdgeAndFromWhatIsOutside) {
  HeightMap map(Grid{7, 9, 1.0, 1.0, {}}, std::vector<double>(63, 1.0));
  EXPECT_EQ(steps_from_rim(map)[static_cast<std::size_t>(map.grid.index(3, 4))], 3);
  for (Index r = 0; r < 3; ++r) map.at(r, 4) = kMissing;
  const std::vector<Index> steps = steps_from_rim(map);
  const auto at = [&](Index r, Index c) { return steps[static_cast<std::size_t>(map.grid.index(r, c))]; };
  EXPECT_EQ(at(1, 4), -1);
  EXPECT_EQ(at(3, 4), 0);
  EXPECT_EQ(at(4, 5), 1);
  EXPECT_EQ(at(1, 2), 1);
}

TEST(RateRim, IsTheMeanThereAndNotWithin) {
  HeightMap rates = test::measured_tool();
  for (double& v : rates.values) v += 0.3;
  rates.at(0, 56) = 0.9;  // an outlier does not count as scatter
  const RateRim rim = rate_rim(rates);
  EXPECT_EQ(rim.samples, 2 * 49 + 2 * 55);
  EXPECT_NEAR(rim.mean, 0.3, 0.01);
  EXPECT_EQ(rim.largest, 0.9);
  EXPECT_EQ(rim.largest_at, rates.grid.centre(0, 56));
  EXPECT_LT(rim.scatter, 0.001);
}

TEST(MendPedestal, TakesTheMeanOfTheRimOff) {
  const HeightMap tool = test::measured_tool();
  HeightMap rates = tool;
  for (double& v : rates.values) v += 0.5;
  rates.at(0, 0) = kMissing;
  mend_pedestal(rates, TifPedestal::Subtract);
  EXPECT_NEAR(rates.at(24, 28), tool.at(24, 28), 0.01);
  EXPECT_NEAR(rate_rim(rates).mean, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(rates.at(0, 0)));
  ASSERT_FALSE(rates.history.empty());
  EXPECT_NE(rates.history.back().find("pedestal subtract: mean rate at the rim 0.5 nm/s, that mean"), std::string::npos)
      << rates.history.back();
}

TEST(MendPedestal, TapersTheOuterPartAlone) {
  HeightMap rates(Grid{40, 64, 0.5, 0.25, {}}, std::vector<double>(40 * 64, 2.0));
  mend_pedestal(rates, TifPedestal::Taper);  // over an eighth of 40 samples
  EXPECT_EQ(rates.at(0, 30), 0.0);
  EXPECT_NEAR(rates.at(20, 1), 2.0 * 0.5 * (1.0 - std::cos(std::acos(-1.0) / 5.0)), 1e-12);
  EXPECT_LT(rates.at(4, 30), 2.0);
  EXPECT_EQ(rates.at(5, 30), 2.0);
  EXPECT_NE(rates.history.back().find("outer 5 samples (2.5 mm along x, 1.25 mm along y)"), std::string::npos);
}

TEST(MendPedestal, LeavesWhatIsAccepted) {
  HeightMap rates = test::measured_tool();
  const std::vector<double> before = rates.values;
  mend_pedestal(rates, TifPedestal::Accept);
  EXPECT_EQ(rates.values, before);
  EXPECT_NE(rates.history.back().find("left as they are"), std::string::npos);
}

TEST(TifPedestal, HasThreeWords) {
  for (const char* word : {"subtract", "taper", "accept"}) EXPECT_EQ(to_string(parse_tif_pedestal(word)), word);
  test::expect_input_error([] { parse_tif_pedestal("cut"); }, {"'cut'", "subtract, taper or accept"});
}

}  // namespace
}  // namespace dwell
