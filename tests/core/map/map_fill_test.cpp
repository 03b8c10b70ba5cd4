#include "core/map/map_fill.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <vector>

#include "core/numerics/laplace.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

using test::kNoData;
using test::map_of;
using test::uneven_map;

double harmonic(double x, double y) { return 7.0 + x * x - y * y + 3.0 * x * y - 2.0 * x; }

TEST(FillHoles, IsExactForAHarmonicFunctionOnUnequalPitches) {
  const Grid grid{120, 160, 0.3, 0.2, {-20.0, 5.0}};
  const HeightMap whole = map_of(grid, harmonic);
  HeightMap map = whole;
  for (Index r = 0; r < grid.rows; ++r) {
    for (Index c = 0; c < grid.cols; ++c) {
      const bool disc = std::hypot(static_cast<double>(r - 60), static_cast<double>(c - 70)) < 41.3;
      const bool scratch = r == c - 37 || (r == 7 && c > 3 && c < 150);
      const bool edge = r > 110 && c > 150;
      if (disc || scratch || edge) map.at(r, c) = kNoData;
    }
  }
  const HeightMap before = map;
  const FillSummary summary = fill_holes(map, {});
  EXPECT_GT(summary.pixels, 5000);  // more than the direct solver's share: several levels
  double worst = 0.0;
  for (Index r = 0; r < grid.rows; ++r) {
    for (Index c = 0; c < grid.cols; ++c) {
      const bool reaches_edge = std::isnan(map.at(r, c));
      EXPECT_EQ(reaches_edge, (r > 110 && c > 150) || (r == c - 37 && std::isnan(map.at(r, c)))) << r << " " << c;
      if (!reaches_edge) worst = std::max(worst, std::abs(map.at(r, c) - whole.at(r, c)));
      if (std::isfinite(before.at(r, c))) {
        EXPECT_EQ(map.at(r, c), before.at(r, c));
      }
    }
  }
  EXPECT_LE(worst, 1e-7);
}

/// Oracle: dense five-point equations, assembled from the definition.
std::vector<double> dense_laplace(const HeightMap& map, const std::vector<unsigned char>& unknown) {
  const Grid& g = map.grid;
  const Index n = g.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b(n);
  const auto open = [&](Index i) { return unknown[static_cast<std::size_t>(i)] != 0; };
  for (Index i = 0; i < n; ++i) {
    const double value = map.values[static_cast<std::size_t>(i)];
    b[i] = std::isfinite(value) ? value : 0.0;
    if (!open(i)) continue;
    b[i] = 0.0;
    a(i, i) = 0.0;
    for (Index j = 0; j < n; ++j) {
      const Index dr = std::abs(i / g.cols - j / g.cols), dc = std::abs(i % g.cols - j % g.cols);
      if (dr + dc != 1 || (!open(j) && std::isnan(map.values[static_cast<std::size_t>(j)]))) continue;
      const double weight = dr == 1 ? 1.0 / (g.pitch_y * g.pitch_y) : 1.0 / (g.pitch_x * g.pitch_x);
      a(i, i) += weight;
      a(i, j) -= weight;
    }
  }
  const Eigen::VectorXd x = oracle::solve_by_elimination(a, b);
  return {x.begin(), x.end()};
}

TEST(FillHoles, AgreesWithDenseEquationsInsideAndWithAll) {
  const HeightMap map = uneven_map(13, 17);
  for (const bool all : {false, true}) {
    HeightMap filled = map;
    const FillSummary summary = fill_holes(filled, {all, 0.0});
    EXPECT_EQ(summary.holes, all ? 2 : 1);
    EXPECT_EQ(summary.pixels, all ? 10 : 4);
    std::vector<unsigned char> unknown(map.values.size());
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      const Index row = static_cast<Index>(i) / 17;
      unknown[i] = std::isnan(map.values[i]) && (all || row > 1) ? 1 : 0;
    }
    const std::vector<double> expected = dense_laplace(map, unknown);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isnan(map.values[i]) && unknown[i] == 0) {
        EXPECT_TRUE(std::isnan(filled.values[i]));
      } else {
        EXPECT_NEAR(filled.values[i], expected[i], 1e-9);
      }
    }
  }
}

TEST(Laplace, InsulatesWhatIsNeitherKnownNorUnknown) {
  // Large enough for several levels: 5,000 unknowns between data at the left and at the right, a wall of NaN between.
  HeightMap map(Grid{60, 90, 0.3, 0.2, {}});
  std::vector<unsigned char> unknown(map.values.size(), 1);
  for (Index r = 0; r < 60; ++r) {
    map.at(r, 0) = 100000.0;
    map.at(r, 89) = 100010.0;
    for (const Index c : {Index{0}, Index{89}}) unknown[static_cast<std::size_t>(map.grid.index(r, c))] = 0;
    if (r != 31) unknown[static_cast<std::size_t>(map.grid.index(r, 44))] = 0;
  }
  const LaplaceSummary summary = solve_laplace(map.grid, unknown, map.values);
  EXPECT_EQ(summary.unknowns, 60 * 88 - 59);
  EXPECT_LE(summary.residual, 1e-11);
  double worst = 0.0;
  for (Index r = 0; r < 60; ++r) {
    for (Index c = 1; c < 89; ++c) {
      if (unknown[static_cast<std::size_t>(map.grid.index(r, c))] == 0) {
        EXPECT_TRUE(std::isnan(map.at(r, c)));
        continue;
      }
      double flow = 0.0;
      const auto link = [&](Index row, Index col, double weight) {
        if (row < 0 || row >= 60 || std::isnan(map.at(row, col))) return;
        flow += weight * (map.at(row, col) - map.at(r, c));
      };
      link(r, c - 1, 1 / 0.09), link(r, c + 1, 1 / 0.09), link(r - 1, c, 1 / 0.04), link(r + 1, c, 1 / 0.04);
      worst = std::max(worst, std::abs(flow));
    }
  }
  EXPECT_LE(worst, 1e-7);
  EXPECT_LT(map.at(5, 43), 100005.0);
  EXPECT_GT(map.at(5, 45), 100005.0);
}

TEST(FillHoles, LeavesLargeOnes) {
  HeightMap map = uneven_map(13, 17);
  map.at(9, 2) = kNoData;
  const FillSummary summary = fill_holes(map, {false, 3.5 * 0.3 * 0.2});
  EXPECT_EQ(summary.holes, 1);
  EXPECT_EQ(summary.left, 1);
  EXPECT_TRUE(std::isfinite(map.at(9, 2)));
  EXPECT_TRUE(std::isnan(map.at(3, 6)));
}

TEST(FillHoles, StopsWhenToldAndRefusesAnEmptyMap) {
  HeightMap map = uneven_map();
  EXPECT_THROW(fill_holes(map, {}, Progress{{}, [] { return true; }}), Interrupted);
  HeightMap empty(Grid{3, 2, 1, 1, {}});
  test::expect_input_error([&] { fill_holes(empty, {true, 0.0}); }, {"finite pixel"});
}

}  // namespace
}  // namespace dwell
