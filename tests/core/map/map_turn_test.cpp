#include "core/map/map_turn.h"

#include <gtest/gtest.h>

#include "core/base/grid_limit.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::uneven_map;

struct Case {
  GridTurn turn;
  // The matrix of the turn, written out by hand.
  double xx, xy, yx, yy;
};

void PrintTo(const Case& c, std::ostream* out) { *out << static_cast<int>(c.turn); }

class MapTurn : public testing::TestWithParam<Case> {};

/// The pixel of the map whose centre is at p, which must lie on one.
double height_at(const HeightMap& map, Point p) {
  const double col = (p.x - map.grid.origin.x) / map.grid.pitch_x, row = (p.y - map.grid.origin.y) / map.grid.pitch_y;
  EXPECT_LE(std::abs(col - std::round(col)) + std::abs(row - std::round(row)), 1e-9);
  return map.at(static_cast<Index>(std::round(row)), static_cast<Index>(std::round(col)));
}

TEST_P(MapTurn, PutsEveryHeightWhereTheMatrixSaysAboutTheMiddleAndAboutAPoint) {
  const auto [turn, xx, xy, yx, yy] = GetParam();
  const HeightMap map = uneven_map();
  const Point middle{-1.1 + 0.5 * 13 * 0.3, 2.3 + 0.5 * 8 * 0.2};
  for (const auto& about : {std::optional<Point>(), std::optional<Point>({0.7, -1.9}), std::optional<Point>(Point{})}) {
    const HeightMap result = turn_map(map, turn, about);
    const Point centre = about.value_or(middle);
    ASSERT_EQ(result.grid.size(), map.grid.size());
    EXPECT_EQ(result.valid_pixels(), map.valid_pixels());
    EXPECT_EQ(result.history, map.history);
    for (Index i = 0; i < map.grid.size(); ++i) {
      const Point p = map.grid.centre(i), d = p - centre;
      const Point q = centre + Point{xx * d.x + xy * d.y, yx * d.x + yy * d.y};
      EXPECT_LE(distance(turn_point(p, turn, centre), q), 1e-12);
      const double before = map.values[static_cast<std::size_t>(i)], after = height_at(result, q);
      EXPECT_TRUE(before == after || (std::isnan(before) && std::isnan(after))) << i;
    }
    if (!about) {
      EXPECT_LE(distance(middle_of(result.grid), middle), 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, MapTurn,
                         testing::Values(Case{GridTurn::FlipX, -1, 0, 0, 1}, Case{GridTurn::FlipY, 1, 0, 0, -1},
                                         Case{GridTurn::Quarter, 0, -1, 1, 0}, Case{GridTurn::Half, -1, 0, 0, -1},
                                         Case{GridTurn::ThreeQuarters, 0, 1, -1, 0},
                                         Case{GridTurn::Transpose, 0, 1, 1, 0}));

TEST(MapTurns, ComposeToTheIdentity) {
  const HeightMap map = uneven_map();
  for (const auto& [turn, times] : {std::pair{GridTurn::FlipX, 2}, {GridTurn::FlipY, 2}, {GridTurn::Half, 2}}) {
    HeightMap result = map;
    for (int i = 0; i < times; ++i) result = turn_map(result, turn);
    test::expect_same_map(result, map);
  }
  for (const auto& [turn, times] :
       {std::pair{GridTurn::Quarter, 4}, {GridTurn::ThreeQuarters, 4}, {GridTurn::Transpose, 2}}) {
    HeightMap result = map;
    for (int i = 0; i < times; ++i) result = turn_map(result, turn);
    EXPECT_LE(distance(result.grid.origin, map.grid.origin), 1e-14);
    result.grid.origin = map.grid.origin;
    test::expect_same_map(result, map);
  }
}

}  // namespace
}  // namespace dwell
