#include "paths/tours/spanning_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "paths/domain/point_tree.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::kInf;
using test::kNaN;
using test::message_of;

/// Prim's algorithm over the full matrix of distances.
double prim(const std::vector<Point>& points) {
  std::vector<double> gap(points.size(), kInf);
  std::vector<char> in(points.size(), 0);
  gap[0] = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::size_t next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!in[i] && (next == points.size() || gap[i] < gap[next])) next = i;
    }
    in[next] = 1;
    sum += gap[next];
    for (std::size_t i = 0; i < points.size(); ++i) {
      gap[i] = std::min(gap[i], std::hypot(points[i].x - points[next].x, points[i].y - points[next].y));
    }
  }
  return sum;
}

std::vector<std::vector<Point>> point_sets() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<std::vector<Point>> sets(6);
  for (int k = 0; k < 900; ++k) sets[0].push_back({30.0 * even(random) - 50.0, 7.0 * even(random)});
  for (int k = 0; k < 900; ++k) {  // clusters of very different density, far apart
    const double spread = std::pow(10.0, -(k % 5));
    sets[1].push_back({100.0 * (k % 5) + spread * normal(random), 3.0 * (k % 3) + spread * normal(random)});
  }
  for (int row = 0; row < 30; ++row) {
    for (int col = 0; col < 40; ++col) {
      if (even(random) < 0.55) sets[2].push_back({0.7 * col, 0.7 * row});  // ties everywhere
    }
  }
  for (int k = 0; k < 300; ++k) sets[3].push_back({0.5 * (k * 37 % 300), 0.25 * (k * 37 % 300)});  // a line
  for (int k = 0; k < 500; ++k) sets[4].push_back({std::floor(9.0 * even(random)), std::floor(5.0 * even(random))});
  for (int k = 0; k < 400; ++k) {  // all equally far from the middle
    sets[5].push_back({std::cos(0.01570796326794897 * k), std::sin(0.01570796326794897 * k)});
  }
  sets[5].push_back({0.0, 0.0});
  return sets;
}

TEST(SpanningTree, AgreesWithPrimOverAllDistances) {
  for (const std::vector<Point>& points : point_sets()) {
    const double expected = prim(points);
    EXPECT_NEAR(spanning_tree_length(points), expected, 1e-11 * expected);
  }
}

TEST(SpanningTree, OfFewPoints) {
  EXPECT_EQ(spanning_tree_length({{3, 4}}), 0.0);
  EXPECT_EQ(spanning_tree_length({{3, 4}, {3, 4}}), 0.0);
  EXPECT_DOUBLE_EQ(spanning_tree_length({{0, 0}, {3, 4}}), 5.0);
  EXPECT_DOUBLE_EQ(spanning_tree_length({{0, 0}, {3, 4}, {3, 0}}), 7.0);
}

TEST(SpanningTree, OfAFullLatticeIsOnePitchLessThanItsPoints) {
  std::vector<Point> points;
  for (int row = 0; row < 210; ++row) {
    for (int col = 0; col < 330; ++col) points.push_back({0.5 * col, 0.5 * row});
  }
  EXPECT_NEAR(spanning_tree_length(points), 0.5 * (210 * 330 - 1), 1e-6);
}

TEST(SpanningTree, RefusesWhatHasNoLength) {
  EXPECT_EQ(message_of([] { spanning_tree_length({}); }), "spanning tree: no points; at least one is required");
  EXPECT_EQ(message_of([] {
              spanning_tree_length({{0, 0}, {kNaN, 1}});
            }),
            "spanning tree: point 2 is (nan, 1); required finite");
  EXPECT_EQ(message_of([] {
              spanning_tree_length({{0, kInf}});
            }),
            "spanning tree: point 1 is (0, inf); required finite");
}

TEST(PointTree, FindsTheNearestAsLookingAtAllDoes) {
  for (const std::vector<Point>& points : point_sets()) {
    const PointTree tree(points);
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i < points.size(); i += 7) {
      const auto to = [&](std::size_t k) { return std::hypot(points[k].x - points[i].x, points[k].y - points[i].y); };
      std::vector<double> all;
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (k != i) all.push_back(to(k));
      }
      std::sort(all.begin(), all.end());
      for (const std::size_t count : {1u, 8u}) {
        tree.nearest(static_cast<std::int32_t>(i), count, found);
        ASSERT_EQ(found.size(), count);
        for (std::size_t k = 0; k < count; ++k) {
          EXPECT_NE(static_cast<std::size_t>(found[k]), i);
          EXPECT_NEAR(to(static_cast<std::size_t>(found[k])), all[k], 1e-12);
        }
        std::sort(found.begin(), found.end());
        EXPECT_EQ(std::unique(found.begin(), found.end()), found.end());
      }
    }
  }
}

TEST(PointTree, HasNoMoreNeighboursThanPoints) {
  const PointTree tree({{1, 2}, {4, 2}});
  std::vector<std::int32_t> found{7};
  tree.nearest(0, 5, found);
  EXPECT_EQ(found, (std::vector<std::int32_t>{1}));
  tree.nearest(0, 0, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace dwell
