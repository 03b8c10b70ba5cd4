#include "core/map/map_outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::uneven_map;

double sorted_median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
}

/// The map with made-up noise of a few tenths of a nanometre.
HeightMap noisy_map() {
  HeightMap map = uneven_map(31, 43);
  unsigned state = 7u;
  for (double& v : map.values) {
    state = state * 1664525u + 1013904223u;
    v = 0.05 * v + 1e-9 * static_cast<double>(state >> 2);
  }
  return map;
}

TEST(Outliers, AreThoseOfTheDefinition) {
  HeightMap map = noisy_map();
  map.at(12, 20) += 9.0, map.at(0, 0) -= 9.0, map.at(30, 42) += 9.0, map.at(3, 8) += 4.0;
  for (const double sigmas : {1.5, 3.0, 5.0}) {
    for (const Index window : {3, 7}) {
      const OutlierOptions options{sigmas, window, 0.01};
      HeightMap cleaned = map;
      const Index removed = remove_outliers(cleaned, options, 2);
      Index expected = 0;
      for (Index r = 0; r < 31; ++r) {
        for (Index c = 0; c < 43; ++c) {
          std::vector<double> near, away;
          for (const Index i : finite_pixels(map)) {
            if (std::abs(i / 43 - r) <= window / 2 && std::abs(i % 43 - c) <= window / 2)
              near.push_back(map.values[static_cast<std::size_t>(i)]);
          }
          bool out = false;
          if (std::isfinite(map.at(r, c)) && near.size() >= 5) {
            const double middle = sorted_median(near);
            for (const double v : near) away.push_back(std::abs(v - middle));
            out = std::abs(map.at(r, c) - middle) > sigmas * std::max(0.01, 1.4826 * sorted_median(away));
          }
          expected += out ? 1 : 0;
          EXPECT_EQ(std::isnan(cleaned.at(r, c)), out || std::isnan(map.at(r, c))) << r << " " << c;
        }
      }
      EXPECT_EQ(removed, expected);
      EXPECT_GE(removed, 3);
    }
  }
}

TEST(Outliers, SpikeOnAFlatMapGoesAndAFloorKeepsIt) {
  HeightMap map(Grid{6, 8, 0.3, 0.2, {}}, std::vector<double>(48, 5.0));
  map.at(2, 3) = 5.5;
  HeightMap kept = map;
  EXPECT_EQ(remove_outliers(map, {}), 1);
  EXPECT_TRUE(std::isnan(map.at(2, 3)));
  EXPECT_EQ(remove_outliers(kept, {5.0, 5, 0.2}), 0);
}

TEST(Outliers, FewNeighboursAreNotJudged) {
  HeightMap map(Grid{9, 9, 1, 1, {}});
  map.at(4, 4) = 100.0;
  for (const Index c : {3, 4, 5}) map.at(3, c) = 0.0;
  EXPECT_EQ(remove_outliers(map, {3.0, 3, 0.0}), 0);
  map.at(5, 4) = 0.0;
  EXPECT_EQ(remove_outliers(map, {3.0, 3, 0.0}), 1);
}

TEST(Outliers, RefuseOptionsOutOfRange) {
  HeightMap map = uneven_map();
  expect_input_error([&] { remove_outliers(map, {0.0, 7, 0.0}); }, {"0 standard deviations"});
  expect_input_error([&] { remove_outliers(map, {kNoData, 7, 0.0}); }, {"standard deviations"});
  for (const Index window : {1, 4, 103, -3}) {
    expect_input_error([&] { remove_outliers(map, {5.0, window, 0.0}); }, {"window", "odd number from 3 to 101"});
  }
  expect_input_error([&] { remove_outliers(map, {5.0, 7, -1.0}); }, {"floor = -1"});
}

TEST(Limits, RemoveHeightsAndSlopesBeyond) {
  const double n = kNoData;
  const HeightMap map(Grid{3, 4, 0.5, 0.25, {}}, {0, 1, 2, 9,  //
                                                  0, 1, n, 3,  //
                                                  0, 1, 2, 3});
  HeightMap low = map;
  EXPECT_EQ(remove_beyond(low, {2.0, 0.0}), 1);  // the median is 1
  test::expect_same_map(low, HeightMap(map.grid, {0, 1, 2, n, 0, 1, n, 3, 0, 1, 2, 3}));
  HeightMap flat = map;
  EXPECT_EQ(remove_beyond(flat, {0.0, 2.0}), 3);  // 14 nm/mm in x, 24 in y; all others 2
  test::expect_same_map(flat, HeightMap(map.grid, {0, 1, n, n, 0, 1, n, n, 0, 1, 2, 3}));
  HeightMap diagonal(Grid{2, 2, 0.5, 0.25, {}}, {0, 1, 1, 2});  // slopes 2 and 4: together 4.47
  EXPECT_EQ(remove_beyond(diagonal, {0.0, 4.5}), 0);
  expect_input_error([&] { remove_beyond(diagonal, {0.0, 4.4}); }, {"all 4 pixels"});
  expect_input_error([&] { remove_beyond(diagonal, {0.0, 0.0}); }, {"one > 0"});
  expect_input_error([&] { remove_beyond(diagonal, {-1.0, 2.0}); }, {"-1 nm"});
  expect_input_error([&] { remove_beyond(diagonal, {kNoData, 2.0}); }, {"nan nm"});
}

}  // namespace
}  // namespace dwell
