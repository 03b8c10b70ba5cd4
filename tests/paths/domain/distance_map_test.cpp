#include "paths/domain/distance_map.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::brute_force_distance;
using test::kInf;
using test::kNaN;

HeightMap sparse_map(Index rows, Index cols, double pitch_x, double pitch_y, double share, unsigned seed) {
  HeightMap map(Grid{rows, cols, pitch_x, pitch_y, {-3.25, 7.5}});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (double& v : map.values) {
    if (uniform(random) < share) v = 0.0;
  }
  map.at(rows / 2, cols / 3) = 0.0;
  return map;
}

struct Case {
  double pitch_x, pitch_y, share, margin;
};

class DistanceMapTest : public ::testing::TestWithParam<Case> {};

TEST_P(DistanceMapTest, AgreesWithBruteForceAtNodesAndBetween) {
  const Case c = GetParam();
  const HeightMap map = sparse_map(17, 23, c.pitch_x, c.pitch_y, c.share, 5);
  const DistanceMap distance_map(map, c.margin);
  for (Index row = 0; row < distance_map.nodes().rows; ++row) {
    for (Index col = 0; col < distance_map.nodes().cols; ++col) {
      ASSERT_NEAR(distance_map.at_node(row, col), brute_force_distance(map, distance_map.nodes().centre(row, col)),
                  1e-12);
    }
  }
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-20.0, 40.0), y(-20.0, 40.0), factor(0.5, 1.5);
  for (int i = 0; i < 2000; ++i) {
    const Point p{x(random), y(random)};
    const double truth = brute_force_distance(map, p);
    ASSERT_NEAR(distance_map(p), truth, 1e-12) << p.x << ' ' << p.y;
    const double reach = truth * factor(random);
    ASSERT_EQ(distance_map.within(p, reach), truth <= reach);
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, DistanceMapTest,
                         ::testing::Values(Case{1.0, 1.0, 0.02, 0.0}, Case{1.0, 1.0, 0.3, 4.0},
                                           Case{0.25, 1.5, 0.02, 6.0}, Case{2.0, 0.1, 0.05, 3.0},
                                           Case{0.7, 0.7, 0.0, 100.0}, Case{1.0, 3.0, 1.0, 2.5}));

TEST(DistanceMap, ExtendsTheGridByTheMarginUpToTheMapsExtent) {
  const HeightMap map = test::full_map(4, 10, 0.5, 2.0, {1.0, 2.0});
  const DistanceMap small(map, 1.2);
  EXPECT_EQ(small.nodes().cols, 10 + 2 * 3);
  EXPECT_EQ(small.nodes().rows, 4 + 2 * 1);
  EXPECT_DOUBLE_EQ(small.nodes().origin.x, 1.0 - 1.5);
  EXPECT_DOUBLE_EQ(small.nodes().origin.y, 2.0 - 2.0);
  const DistanceMap huge(map, 1e9);
  EXPECT_EQ(huge.nodes().cols, 30);
  EXPECT_EQ(huge.nodes().rows, 12);
  EXPECT_NEAR(huge({1.0, -1000.0}), 1002.0, 1e-9);
}

TEST(DistanceMap, RefusesAnEmptyMapAndBadMargins) {
  const HeightMap empty(Grid{3, 4, 1.0, 1.0, {}});
  EXPECT_EQ(test::message_of([&] { DistanceMap(empty, 1.0); }),
            "map of 3 x 4 pixels has no finite value; at least one is required");
  const HeightMap map = test::full_map(2, 2);
  for (const double margin : {-1.0, kNaN, kInf}) {
    EXPECT_NE(test::message_of([&] { DistanceMap(map, margin); }).find("required finite and >= 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace dwell
