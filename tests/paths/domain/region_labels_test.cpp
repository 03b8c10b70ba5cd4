#include "paths/domain/region_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

/// The valid pixel whose centre is nearest to a place, by looking at all; ties to any.
std::vector<Index> nearest_by_force(const HeightMap& map, Point place) {
  double best = test::kInf;
  for (const Index i : finite_pixels(map)) best = std::min(best, distance(map.grid.centre(i), place));
  std::vector<Index> nearest;
  for (const Index i : finite_pixels(map)) {
    if (distance(map.grid.centre(i), place) <= best * (1.0 + 1e-12)) nearest.push_back(i);
  }
  return nearest;
}

TEST(RegionLabels, AgreeWithTheirDefinition) {
  std::mt19937_64 random(17);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  HeightMap map(Grid{13, 19, 0.7, 0.4, {-3.0, 8.0}});
  std::vector<std::int32_t> regions(map.values.size(), 0);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (random() % 3 == 0) continue;
    regions[i] = 1 + static_cast<std::int32_t>(random() % 3);
    map.values[i] = 1.0;
  }
  const std::vector<double> reaches{0.45, 1.0, 2.6};
  const RegionLabels labels(map, regions, reaches, "test");
  const Grid& g = map.grid;
  int outside = 0, beyond = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Point p{uniform(-8.0, 15.0), uniform(4.0, 17.0)};
    const auto col = static_cast<Index>(std::floor((p.x - g.origin.x) / g.pitch_x + 0.5));
    const auto row = static_cast<Index>(std::floor((p.y - g.origin.y) / g.pitch_y + 0.5));
    const bool on_map = col >= 0 && row >= 0 && col < g.cols && row < g.rows;
    const std::int32_t own = on_map ? regions[static_cast<std::size_t>(g.index(row, col))] : 0;
    const std::int32_t label = labels.at(p);
    if (own > 0) {
      EXPECT_EQ(label, own);
      continue;
    }
    std::vector<std::int32_t> accepted;
    const double away = test::brute_force_distance(map, p);
    for (const Index i : nearest_by_force(map, g.centre(row, col))) {
      const std::int32_t region = regions[static_cast<std::size_t>(i)];
      accepted.push_back(away <= reaches[static_cast<std::size_t>(region - 1)] ? region : 0);
    }
    EXPECT_NE(std::find(accepted.begin(), accepted.end(), label), accepted.end()) << p.x << " " << p.y;
    ++(label == 0 ? outside : beyond);
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(beyond, 1000);
}

TEST(RegionLabels, RefuseAMarginThatIsTooWide) {
  const HeightMap map = test::full_map(3, 4, 0.1, 0.1);
  const std::vector<std::int32_t> regions(12, 1);
  EXPECT_NE(test::message_of([&] { RegionLabels(map, regions, {1e6}, "test"); }).find("test: the map with 1e+06 mm"),
            std::string::npos);
  EXPECT_NE(test::message_of([&] { RegionLabels(map, regions, {1e300}, "test"); }).find("at most 1e+08"),
            std::string::npos);
}

}  // namespace
}  // namespace dwell
