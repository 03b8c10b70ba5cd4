#include "runs/acceptance/surface_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "core/map/surface_slope.h"

namespace dwell {
namespace {

const std::vector<double> kEdges{33.0, 0.12};

TEST(SurfaceLimits, ReadsQuantitiesNumbersAndUnits) {
  const auto limits = parse_surface_limits(
      "rms<=1, PV <= 0.01um, pvr<=80A,slope<=0.2urad, mid<=0.5, band(0.3..3mm)<=250pm, band(7mm..5mm)<=1", kEdges);
  ASSERT_EQ(limits.size(), 7U);
  EXPECT_EQ(limits[0].quantity, SurfaceQuantity::Rms);
  EXPECT_EQ(limits[0].most, 1.0);
  EXPECT_DOUBLE_EQ(limits[1].most, 10.0);
  EXPECT_DOUBLE_EQ(limits[2].most, 8.0);
  EXPECT_EQ(limits[3].quantity, SurfaceQuantity::Slope);
  EXPECT_DOUBLE_EQ(limits[3].most, 0.2);
  EXPECT_EQ(limits[4].longest, 33.0);
  EXPECT_EQ(limits[4].shortest, 0.12);
  EXPECT_DOUBLE_EQ(limits[5].most, 0.25);
  EXPECT_EQ(limits[6].shortest, 5.0);
  EXPECT_EQ(limits[6].longest, 7.0);
  EXPECT_NEAR(parse_surface_limits("slope<=1arcsec", kEdges)[0].most, std::numbers::pi / 180.0 / 3600.0 * 1e6, 1e-9);
  EXPECT_DOUBLE_EQ(parse_surface_limits("slope<=300nrad", kEdges)[0].most, 0.3);
}

TEST(SurfaceLimits, AreTextThatReadsBack) {
  const auto limits = parse_surface_limits("mid<=0.5um, slope<=2nrad, pv<=3", kEdges);
  const auto again = parse_surface_limits(surface_limits_text(limits), {9.0, 5.0});
  ASSERT_EQ(again.size(), limits.size());
  for (std::size_t k = 0; k < limits.size(); ++k) {
    EXPECT_EQ(again[k].quantity, limits[k].quantity);
    EXPECT_EQ(again[k].most, limits[k].most);
    EXPECT_EQ(again[k].longest, limits[k].longest);
    EXPECT_EQ(again[k].shortest, limits[k].shortest);
  }
}

TEST(SurfaceLimits, RefusesByTextPartAndReason) {
  for (const char* text : {"",
                           "rms",
                           "rms<1",
                           "rms<=",
                           "rms<=x",
                           "rms<=-1",
                           "rms<=0",
                           "rms<=nan",
                           "rms<=1 2",
                           "rms<=1urad",
                           "slope<=1nm",
                           "rms<=1m",
                           "rms<=1lambda",
                           "ra<=1",
                           "rms<=1,",
                           "rms<=1,rms<=2",
                           "band(3mm)<=1",
                           "band(1..2)<=1",
                           "band(1..1mm)<=1",
                           "band(-1..2mm)<=1",
                           "band(1..2um)<=1",
                           "mid<=1,band(0.12..33mm)<=2",
                           "rms>=1",
                           "rms<=1e400"}) {
    try {
      parse_surface_limits(text, kEdges);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("accepted: QUANTITY<=NUMBER[UNIT]"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parse_surface_limits("mid<=1", {33.0, 5.0, 1.0}), InputError);
}

/// A wave along x of 20 nm and 4 mm, and a tilt that the form takes out.
HeightMap wavy() {
  HeightMap map(Grid{120, 160, 0.25, 0.2, {-20.0, -10.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 20.0 * std::cos(2.0 * std::numbers::pi * p.x / 4.0) + 5.0 * p.y + 7.0;
  }
  return map;
}

TEST(SurfaceLimits, JudgesAgainstKnownValues) {
  const auto verdicts = judge_surface(
      wavy(), {true, true},
      parse_surface_limits("rms<=14.2, pv<=39, slope<=30, band(2..8mm)<=20, band(0.5..1.5mm)<=0.1, band(200..300mm)<=1",
                           kEdges));
  ASSERT_EQ(verdicts.size(), 6U);
  EXPECT_NEAR(*verdicts[0].value, 20.0 / std::sqrt(2.0), 0.05);
  EXPECT_TRUE(verdicts[0].passes());
  EXPECT_NEAR(*verdicts[1].value, 40.0, 1.0);
  EXPECT_FALSE(verdicts[1].passes());
  EXPECT_DOUBLE_EQ(verdicts[1].margin(), 39.0 - *verdicts[1].value);
  EXPECT_NEAR(*verdicts[2].value, 20.0 * 2.0 * std::numbers::pi / 4.0 / std::sqrt(2.0), 0.3);
  EXPECT_NEAR(*verdicts[3].value, 20.0 / std::sqrt(2.0), 0.3);
  EXPECT_LT(*verdicts[4].value, 0.1);
  EXPECT_FALSE(verdicts[5].value);  // longer than the part: not known, and so not passed
  EXPECT_FALSE(verdicts[5].passes());
  EXPECT_FALSE(all_pass(verdicts));
  const std::string lines = verdict_lines(verdicts);
  EXPECT_NE(lines.find("pv                at most 39 nm"), std::string::npos) << lines;
  EXPECT_NE(lines.find("too much: FAILS"), std::string::npos) << lines;
  EXPECT_NE(lines.find("urad"), std::string::npos) << lines;
}

}  // namespace
}  // namespace dwell
