#include "core/form/map_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(MapStatistics, HandCheckedNumbers) {
  // 1, 2, 3, 6: mean 3, deviations -2 -1 0 3; sum of squares 50 about zero, 14 about the mean.
  const HeightMap map({2, 3, 0.5, 0.5, {}}, {1.0, 2.0, kNaN, 3.0, kNaN, 6.0});
  const MapStatistics raw = map_statistics(map, {});
  EXPECT_EQ(raw.valid_pixels, 4);
  EXPECT_DOUBLE_EQ(raw.pv, 5.0);
  EXPECT_DOUBLE_EQ(raw.rms, std::sqrt(14.0 / 4.0));
  EXPECT_DOUBLE_EQ(raw.mean, 3.0);
  EXPECT_DOUBLE_EQ(raw.rms_about_zero(), std::sqrt(50.0 / 4.0));
  EXPECT_EQ(in_words(raw), "RMS 1.871 nm, PV 5 nm, mean 3 nm (RMS about it; 3.536 nm about zero)");
  const MapStatistics centred = map_statistics(map, {true, false, false});
  EXPECT_DOUBLE_EQ(centred.pv, 5.0);
  EXPECT_DOUBLE_EQ(centred.rms, std::sqrt(14.0 / 4.0));
  EXPECT_NEAR(centred.mean, 0.0, 1e-15);
  EXPECT_EQ(in_words(centred), "RMS 1.871 nm, PV 5 nm");
}

// A small figure on a large piston, which the RMS must not hold, whatever the number of threads.
TEST(MapStatistics, RmsIsNeverMoreThanHalfOfThePv) {
  HeightMap map({37, 23, 0.5, 0.25, {}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    map.values[static_cast<std::size_t>(i)] = i % 7 == 0 ? kNaN : 1e6 + std::sin(0.37 * static_cast<double>(i));
  }
  const MapStatistics one = map_statistics(map, {}, 1), two = map_statistics(map, {}, 2);
  EXPECT_EQ(one.rms, two.rms);
  EXPECT_EQ(one.mean, two.mean);
  EXPECT_LE(one.rms, 0.5 * one.pv);
  EXPECT_NEAR(one.rms, std::sqrt(0.5), 0.02);
  EXPECT_NEAR(one.mean, 1e6, 0.02);
}

TEST(MapStatistics, TiltIsOfTheMillimetresNotOfThePixels) {
  // z = 5 + 2 x + 3 y + d, with d = +1 -1 / -1 +1 at the corners of a square, orthogonal to piston and tilt.
  const HeightMap map({2, 2, 0.5, 2.0, {10.0, 20.0}},
                      {5 + 20 + 60 + 1, 5 + 21 + 60 - 1, 5 + 20 + 66 - 1, 5 + 21 + 66 + 1});
  const MapStatistics statistics = map_statistics(map, {true, true, false});
  EXPECT_NEAR(statistics.pv, 2.0, 1e-12);
  EXPECT_NEAR(statistics.rms, 1.0, 1e-12);
  const HeightMap flat = without_form(map, {true, true, false});
  EXPECT_NEAR(flat.at(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(flat.at(0, 1), -1.0, 1e-12);
  EXPECT_NEAR(flat.at(1, 0), -1.0, 1e-12);
  EXPECT_EQ(flat.grid, map.grid);
}

TEST(MapStatistics, NoDataStaysNoDataAndOtherPixelsMatch) {
  const HeightMap map({1, 3, 1.0, 1.0, {}}, {4.0, kNaN, 8.0});
  test::expect_same_map(without_form(map, {true, false, false}), HeightMap(map.grid, {-2.0, kNaN, 2.0}));
  test::expect_same_map(without_form(map, {}), map);
}

TEST(MapStatistics, RefusesAMapWithoutData) {
  test::expect_input_error([] { map_statistics(HeightMap({2, 2, 1.0, 1.0, {}}), {}); }, {"no finite pixel"});
}

TEST(MapStatistics, MeasuredMirrorHasItsPublishedRms) {
  const std::string file = DWELL_SHARED_DATA "/udo-raster/map_nm.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  MapReadOptions options;
  options.pitch = square_pitch(0.1);  // piston alone does not depend on it
  const HeightMap map = read_map(file, options);
  EXPECT_EQ(map.grid.rows, 168);
  EXPECT_EQ(map.grid.cols, 985);
  EXPECT_NEAR(map_statistics(map, {true, false, false}).rms, 6.317, 5e-4);
}

}  // namespace
}  // namespace dwell
