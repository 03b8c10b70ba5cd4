#include "core/tif/tool_questions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tif/footprint_gaps.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/tif/calibration/spot_truth.h"
#include "tests/core/tif/measured_tool.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::measured_tool;

constexpr double kGapHere = std::numeric_limits<double>::quiet_NaN();

/// What is said of the rates, with the axis in the middle by default; throws what is refused.
std::vector<std::string> said_of(const HeightMap& rates, std::optional<TifPedestal> pedestal = {},
                                 std::optional<TifCentre> centre = {}) {
  HeightMap mended = rates;
  if (pedestal) mend_pedestal(mended, *pedestal);
  const RemovalFunction tif = measured_removal(mended, centre.value_or(TifCentre{}));
  return notes_of(question_tool({rates, tif, !centre, pedestal}));
}

HeightMap with_offset(double offset) {
  HeightMap rates = measured_tool();
  for (double& v : rates.values) v += offset;
  return rates;
}

HeightMap with_noise(double noise) {
  HeightMap rates = measured_tool();
  test::Noise random(11);
  for (double& v : rates.values) v += noise * random();
  return rates;
}

TEST(QuestionTool, HasNoWordForASoundOne) {
  EXPECT_TRUE(said_of(measured_tool()).empty());
  EXPECT_TRUE(said_of(with_noise(0.02)).empty());  // also negative, within its noise
}

TEST(QuestionTool, HasNoWordForAToolWithoutDataAroundIt) {
  HeightMap rates = measured_tool({0.2, -0.1});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    if (distance(rates.grid.centre(i), {40.0, -30.0}) > 4.4) rates.values[static_cast<std::size_t>(i)] = kGapHere;
  }
  rates.at(1, 30) = kGapHere;
  EXPECT_TRUE(said_of(rates).empty());
}

TEST(QuestionTool, RefusesNoDataWithinTheFootprint) {
  HeightMap rates = measured_tool();
  rates.at(24, 28) = kGapHere;  // (40, -30) mm
  expect_input_error([&] { said_of(rates); },
                     {"1 sample without data", "row 25, column 29 (counted from 1; at 40, -30 mm)", "3.9",
                      "`tif steps` fill:harmonic fills it"});
  rates.at(24, 29) = kGapHere;
  expect_input_error([&] { said_of(rates); }, {"2 samples without data", "fills them"});
}

TEST(QuestionTool, RefusesAGapThatIsOpenToTheEdge) {
  HeightMap rates = measured_tool();
  for (Index r = 0; r < 22; ++r) rates.at(r, 30) = kGapHere;  // a dead line that ends beside the peak
  expect_input_error([&] { said_of(rates); }, {"samples without data", "fill:harmonic,all"});
}

TEST(FootprintGaps, AreNoneOutsideAConvexFootprint) {
  HeightMap disc(Grid{41, 51, 1.0, 1.0, {-25.0, -20.0}});
  for (Index i = 0; i < disc.grid.size(); ++i) {
    const Point p = disc.grid.centre(i);
    if (std::hypot(p.x / 17.0, p.y / 12.0) <= 1.0) disc.values[static_cast<std::size_t>(i)] = 3.0;
  }
  EXPECT_EQ(footprint_gaps(disc, 0.03).samples, 0);
  disc.at(20, 30) = disc.at(20, 31) = kGapHere;
  const FootprintGaps gaps = footprint_gaps(disc, 0.03);
  EXPECT_EQ(gaps.samples, 2);
  EXPECT_EQ(gaps.beside, 3.0);
  EXPECT_FALSE(gaps.open);
  EXPECT_EQ(footprint_gaps(disc, 3.5).samples, 0);  // nothing of it is footprint
}

TEST(QuestionTool, SaysAPedestalFromOnePerCentAndRefusesItFromFive) {
  EXPECT_TRUE(said_of(with_offset(0.03)).empty());
  const std::vector<std::string> said = said_of(with_offset(0.1));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("rim of the file is 0.1"), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("% of the peak"), std::string::npos);
  expect_input_error([] { said_of(with_offset(0.5)); }, {"11.", "% of the peak", "`tif pedestal` subtract"});
  for (const TifPedestal how : {TifPedestal::Subtract, TifPedestal::Taper, TifPedestal::Accept}) {
    const std::vector<std::string> done = said_of(with_offset(0.5), how);
    ASSERT_FALSE(done.empty());
    EXPECT_NE(done[0].find("11."), std::string::npos) << "of the peak before it was mended: " << done[0];
  }
}

TEST(QuestionTool, RefusesNegativeRatesBeyondNoise) {
  HeightMap rates = with_noise(0.01);
  rates.at(10, 50) = -0.2;
  expect_input_error([&] { said_of(rates); }, {"row 11, column 51", "-0.2 nm/s", "beyond the noise", "drop:AREA"});
  expect_input_error([] { said_of(with_offset(-0.15)); }, {"-0.15 nm/s", "`tif pedestal` subtract"});
  EXPECT_NO_THROW(said_of(with_offset(-0.15), TifPedestal::Subtract));
}

TEST(QuestionTool, TakesHeightsForNoTool) {
  HeightMap heights(Grid{50, 61, 0.5, 0.5, {}});
  for (Index i = 0; i < heights.grid.size(); ++i) {
    const Point p = heights.grid.centre(i);
    heights.values[static_cast<std::size_t>(i)] = 17.0 * std::sin(0.31 * p.x + 0.3) * std::cos(0.2 * p.y) + 0.1 * p.x;
  }
  expect_input_error([&] { said_of(heights); }, {"is this a map of heights"});
}

TEST(QuestionTool, WantsTheAxisWhereTheMiddleIsOffCentroidAndPeak) {
  expect_input_error(
      [] {
        said_of(measured_tool({1.0, -0.5}));
      },
      {"where is the tool axis", "the centroid lies (0.", "the apex of its rounded top, which peak means here, (",
       "FWHM is", "`tif centre`"});
  EXPECT_NO_THROW(said_of(measured_tool({1.0, -0.5}), {}, TifCentre{TifCentre::Kind::Middle, {}}));
  EXPECT_NO_THROW(said_of(measured_tool({0.15, 0.1})));
}

// The D of magnetorheological finishing: its centroid is a third of the FWHM off its peak; the axis may be at either.
TEST(QuestionTool, HasNoWordForATrulyAsymmetricToolAboutPeakOrCentroid) {
  for (const double middle : {0.0, -0.3, -0.75}) {
    HeightMap rates(Grid{91, 121, 0.1, 0.1, {-6.0 + middle, -4.5}});
    for (Index i = 0; i < rates.grid.size(); ++i) {
      const Point p = rates.grid.centre(i);
      const double u = p.x / (p.x < 0.0 ? 1.8 : 0.7);
      rates.values[static_cast<std::size_t>(i)] = 12.0 * std::exp2(-(u * u + p.y * p.y));
    }
    EXPECT_TRUE(said_of(rates).empty()) << middle;
  }
}

TEST(QuestionTool, SaysAToolAsWideAsItsFileAndOneThatIsSampledCoarsely) {
  HeightMap cut = measured_tool();
  for (double& v : cut.values) v = v > 0.6 ? v : 0.0;
  HeightMap wide(Grid{17, 57, 0.25, 0.2, {33.0, -31.6}});
  for (Index r = 0; r < 17; ++r) {
    for (Index c = 0; c < 57; ++c) wide.at(r, c) = measured_tool().at(r + 16, c);
  }
  const std::vector<std::string> said = said_of(wide, TifPedestal::Accept);
  ASSERT_GE(said.size(), 2U);
  EXPECT_NE(said[1].find("as wide as its file"), std::string::npos) << said[1];
  HeightMap coarse(Grid{9, 11, 1.0, 1.0, {-5.0, -4.0}});
  for (Index i = 0; i < coarse.grid.size(); ++i) {
    const Point p = coarse.grid.centre(i);
    coarse.values[static_cast<std::size_t>(i)] = std::exp(-0.4 * p.x * p.x - 0.35 * p.y * p.y);
  }
  const std::vector<std::string> few = said_of(coarse);
  ASSERT_EQ(few.size(), 1U);
  EXPECT_NE(few[0].find("pixels only"), std::string::npos) << few[0];
}

TEST(QuestionTool, NamesAllThatIsWrongAtOnce) {
  HeightMap rates = measured_tool({1.2, 0.4});
  for (double& v : rates.values) v += 0.4;
  rates.at(25, 35) = kGapHere;
  expect_input_error([&] { said_of(rates); },
                     {"without data", "besides, ", "rim of the file", "where is the tool axis"});
}

TEST(MeasuredRemoval, IsPlacedAtItsPeak) {
  const HeightMap rates = measured_tool({0.63, -0.37});
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Peak, {}});
  const Point axis = rates.grid.origin - tif.samples.grid.origin;
  EXPECT_NEAR(axis.x, 40.63, 0.12);  // the top is skew
  EXPECT_NEAR(axis.y, -30.37, 0.01);
  HeightMap ring = rates;
  for (Index i = 0; i < ring.grid.size(); ++i) {
    const double r = distance(ring.grid.centre(i), {40.0, -30.0});
    ring.values[static_cast<std::size_t>(i)] = std::exp(-4.0 * (r - 2.0) * (r - 2.0));
  }
  expect_input_error(
      [&] {
        measured_removal(ring, {TifCentre::Kind::Peak, {}});
      },
      {"`tif centre` peak", "not rounded"});
}

}  // namespace
}  // namespace dwell
