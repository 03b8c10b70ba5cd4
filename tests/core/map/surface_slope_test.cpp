#include "core/map/surface_slope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/form/robust_pv.h"

namespace dwell {
namespace {

TEST(Slope, OfAPlaneWithHoles) {
  HeightMap map(Grid{5, 7, 0.5, 0.2, {3.0, 1.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 3.0 * p.x - 4.0 * p.y;
  }
  map.at(2, 3) = std::nan("");
  const SlopeStatistics s = slope_statistics(map, 2);
  EXPECT_NEAR(s.x, 3.0, 1e-12);
  EXPECT_NEAR(s.y, 4.0, 1e-12);
  EXPECT_NEAR(s.total, 5.0, 1e-12);
  EXPECT_EQ(s.pairs_x, 5 * 6 - 2);
  EXPECT_EQ(s.pairs_y, 4 * 7 - 2);
}

TEST(Slope, WithoutPairsIsNone) {
  const HeightMap row(Grid{1, 3, 0.5, 0.2, {}}, {1.0, 2.0, 4.0});
  const SlopeStatistics s = slope_statistics(row);
  EXPECT_NEAR(s.x, std::sqrt((4.0 + 16.0) / 2.0), 1e-12);
  EXPECT_TRUE(std::isnan(s.y));
  EXPECT_EQ(s.total, s.x);  // a line has the slope along it alone
  EXPECT_FALSE(std::isnan(s.total));
}

TEST(RobustPv, IgnoresASpikeAndKeepsTheForm) {
  HeightMap map(Grid{80, 90, 0.5, 0.5, {}});
  for (Index r = 0; r < 80; ++r) {
    for (Index c = 0; c < 90; ++c) {
      const double u = (static_cast<double>(c) - 44.5) / 40.0, v = (static_cast<double>(r) - 39.5) / 40.0;
      if (u * u + v * v < 0.98) map.at(r, c) = 50.0 * (u * u + v * v) + 10.0 * u * v + ((r + c) % 2 ? 0.5 : -0.5);
    }
  }
  const RobustPv clean = robust_pv(map).value();
  EXPECT_NEAR(clean.residual_rms, 0.5, 0.01);
  EXPECT_NEAR(clean.fit_pv, 53.9, 0.6);  // 50 rho^2 + 5 rho^2 sin 2 theta up to the last pixel within rho^2 = 0.98
  EXPECT_NEAR(clean.pvr, clean.fit_pv + 3.0 * clean.residual_rms, 1e-12);
  map.at(30, 41) += 1000.0;
  const RobustPv spiked = robust_pv(map, 2).value();
  EXPECT_LE(spiked.pvr, clean.pvr + 60.0);  // of the 1000 nm: 3 / sqrt(4900 pixels), and the bump in the fit
}

TEST(RobustPv, NeedsAsManyPixelsAsTerms) {
  HeightMap map(Grid{6, 7, 0.5, 0.4, {}}, std::vector<double>(42, 1.0));
  for (std::size_t i = 0; i < 6; ++i) map.values[7 * i] = std::nan("");
  EXPECT_TRUE(robust_pv(map));  // 36
  map.at(2, 3) = std::nan("");
  EXPECT_FALSE(robust_pv(map));
}

TEST(RobustPv, NeedsMoreThanALine) {
  EXPECT_FALSE(robust_pv(HeightMap(Grid{1, 50, 0.5, 0.4, {}}, std::vector<double>(50, 1.0))));
  EXPECT_FALSE(robust_pv(HeightMap(Grid{60, 5, 0.5, 0.4, {}}, std::vector<double>(300, 1.0))));
  EXPECT_TRUE(robust_pv(HeightMap(Grid{60, 6, 0.5, 0.4, {}}, std::vector<double>(360, 1.0))));
}

}  // namespace
}  // namespace dwell
