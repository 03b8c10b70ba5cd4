#include "solvers/problem/surface_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/map/surface_slope.h"
#include "core/removal/sparse_removal.h"

namespace dwell {
namespace {

/// A map of 7 x 9 pixels, longer along y, with a hole, a missing corner and a row that stops short.
HeightMap holed_map() {
  HeightMap map(Grid{7, 9, 0.3, 0.5, {1.0, -2.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Index row = i / map.grid.cols, col = i % map.grid.cols;
    const bool missing = row + col < 3 || (row == 4 && col == 5) || (row == 2 && col > 6);
    if (!missing)
      map.values[static_cast<std::size_t>(i)] =
          std::sin(2.7 * static_cast<double>(i)) + 0.1 * static_cast<double>(row * col);
  }
  return map;
}

Vector heights_of(const HeightMap& map) {
  const std::vector<Index> pixels = finite_pixels(map);
  Vector z(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    z[static_cast<Index>(i)] = map.values[static_cast<std::size_t>(pixels[i])];
  return z;
}

// The statistics of a map take the same slopes in a loop of their own.
TEST(SurfaceRows, AreTheSlopesOfTheMap) {
  const HeightMap map = holed_map();
  const SurfaceRows slopes(map.grid, finite_pixels(map), false);
  const SlopeStatistics expected = slope_statistics(map);
  Vector rows;
  slopes.apply(heights_of(map), rows);
  ASSERT_EQ(slopes.pairs_x(), expected.pairs_x);
  ASSERT_EQ(slopes.pairs_y(), expected.pairs_y);
  ASSERT_EQ(rows.size(), slopes.rows());
  EXPECT_NEAR(rows.head(slopes.pairs_x()).norm() / std::sqrt(static_cast<double>(slopes.pairs_x())), expected.x, 1e-12);
  EXPECT_NEAR(rows.tail(slopes.pairs_y()).norm() / std::sqrt(static_cast<double>(slopes.pairs_y())), expected.y, 1e-12);
}

TEST(SurfaceRows, NameTheTwoPixelsOfASlope) {
  const HeightMap map = holed_map();
  const std::vector<Index> pixels = finite_pixels(map);
  const SurfaceRows both(map.grid, pixels, true);
  const Vector z = heights_of(map);
  Vector rows;
  both.apply(z, rows);
  EXPECT_EQ(both.heights(), z.size());
  EXPECT_TRUE(rows.head(z.size()) == z);
  for (Index k = 0; k < both.pairs_x() + both.pairs_y(); ++k) {
    const auto [a, b] = both.pair(k);
    const bool x = k < both.pairs_x();
    EXPECT_EQ(pixels[static_cast<std::size_t>(b)] - pixels[static_cast<std::size_t>(a)], x ? 1 : map.grid.cols);
    EXPECT_NEAR(rows[both.heights() + k], (z[b] - z[a]) / (x ? 0.3 : 0.5), 1e-12);
  }
}

TEST(SurfaceRows, HaveTheirTransposeForAdjoint) {
  const HeightMap map = holed_map();
  std::mt19937 random(5);
  const auto draw = [&] { return static_cast<double>(random()) / 4e9 - 0.5; };
  for (const bool with_heights : {false, true}) {
    const SurfaceRows rows(map.grid, finite_pixels(map), with_heights);
    const Vector z = Vector::NullaryExpr(rows.pixels(), draw), v = Vector::NullaryExpr(rows.rows(), draw);
    Vector image, back;
    rows.apply(z, image);
    rows.apply_adjoint(v, back);
    EXPECT_NEAR(image.dot(v), z.dot(back), 1e-13 * image.norm() * v.norm());
  }
}

TEST(SurfaceRows, OfARemovalAreRowsOfItsColumns) {
  const HeightMap map = holed_map();
  const SurfaceRows rows(map.grid, finite_pixels(map), true);
  std::mt19937 random(6);
  const auto draw = [&] { return static_cast<double>(random()) / 4e9; };
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(rows.pixels(), 4, draw);
  SparseRemoval heights(SparseRemoval::Matrix(a.sparseView()), 1);
  RowsOfRemoval removal(heights, rows);
  ASSERT_EQ(removal.rows(), rows.rows());
  ASSERT_EQ(removal.cols(), 4);
  Eigen::MatrixXd dense(rows.rows(), 4);
  Vector column, back;
  for (Index j = 0; j < 4; ++j) {
    rows.apply(a.col(j), column);
    dense.col(j) = column;
    removal.apply(Vector::Unit(4, j), column);
    EXPECT_LE((column - dense.col(j)).norm(), 1e-13 * column.norm());
  }
  const Vector v = Vector::NullaryExpr(rows.rows(), draw);
  removal.apply_adjoint(v, back);
  EXPECT_LE((back - dense.transpose() * v).norm(), 1e-13 * back.norm());
}

TEST(SurfaceRows, OfOnePixelAreNone) {
  const SurfaceRows rows(Grid{3, 3, 0.5, 0.25, {}}, {4}, false);
  EXPECT_EQ(rows.rows(), 0);
  EXPECT_EQ(rows.pixels(), 1);
}

}  // namespace
}  // namespace dwell
