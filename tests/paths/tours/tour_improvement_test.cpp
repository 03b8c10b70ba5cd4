#include "paths/tours/tour_improvement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::kInf;
using test::kNaN;
using test::message_of;

std::vector<Index> in_order(std::size_t n) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

std::vector<Index> shuffled(std::size_t n, std::mt19937& random) {
  std::vector<Index> order = in_order(n);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

std::vector<Point> scattered(std::size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> x(-7.0, 20.0), y(100.0, 110.0);
  std::vector<Point> points(n);
  for (Point& p : points) p = {x(random), y(random)};
  return points;
}

double plain_length(const std::vector<Point>& points, const std::vector<Index>& order) {
  double sum = 0.0;
  for (std::size_t j = 1; j < order.size(); ++j) {
    const Point a = points.at(static_cast<std::size_t>(order[j - 1])),
                b = points.at(static_cast<std::size_t>(order[j]));
    sum += std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }
  return sum;
}

/// The shortest open path, by all permutations; from order.front() if the start is fixed.
double shortest(const std::vector<Point>& points, std::vector<Index> order, bool fixed_start) {
  const auto first = order.begin() + (fixed_start ? 1 : 0);
  std::sort(first, order.end());
  double best = kInf;
  do {
    best = std::min(best, plain_length(points, order));
  } while (std::next_permutation(first, order.end()));
  return best;
}

void expect_sound(const ImprovedTour& tour, const std::vector<Point>& points, const std::vector<Index>& given) {
  std::vector<Index> sorted = tour.order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, in_order(points.size()));
  EXPECT_NEAR(tour.length_before, plain_length(points, given), 1e-12 * (1.0 + tour.length_before));
  EXPECT_NEAR(tour.length_after, plain_length(points, tour.order), 1e-12 * (1.0 + tour.length_before));
  EXPECT_LE(tour.length_after, tour.length_before);
  EXPECT_LE(tour.kicks_kept, tour.kicks);
}

/// Cells of a smooth random field above a value, in the order of a serpentine over the whole.
std::vector<Point> islands(Index rows, Index cols, double threshold) {
  std::vector<Point> points;
  for (Index row = 0; row < rows; ++row) {
    for (Index k = 0; k < cols; ++k) {
      const Index col = row % 2 ? cols - 1 - k : k;
      const double x = static_cast<double>(col), y = static_cast<double>(row);
      const double field = std::sin(0.43 * x + 0.3 * std::sin(0.21 * y)) * std::cos(0.37 * y - 0.11 * x) +
                           0.5 * std::sin(1.3 * x - 0.7 * y + 0.01 * x * y) + 0.4 * std::cos(0.9 * y + 0.5 * x);
      if (field >= threshold) points.push_back({0.3 * x - 5.0, 0.3 * y + 2.0});
    }
  }
  return points;
}

/// Greedy path from the first point, O(n^2).
std::vector<Index> greedy(const std::vector<Point>& points) {
  std::vector<Index> order{0};
  std::vector<char> seen(points.size(), 0);
  seen[0] = 1;
  while (order.size() < points.size()) {
    const Point now = points[static_cast<std::size_t>(order.back())];
    std::size_t best = 0;
    double best_d = kInf;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double d = std::round(1e6 * std::hypot(points[k].x - now.x, points[k].y - now.y));
      if (seen[k] || d >= best_d) continue;
      best = k;
      best_d = d;
    }
    seen[best] = 1;
    order.push_back(static_cast<Index>(best));
  }
  return order;
}

TEST(TourImprovement, LiesBetweenTheOptimumAndTheGivenPath) {
  std::mt19937 random(5);
  int optimal = 0, cases = 0;
  for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    for (int repeat = 0; repeat < 12; ++repeat) {
      const std::vector<Point> points = scattered(n, random);
      const std::vector<Index> order = shuffled(n, random);
      for (const bool fixed : {false, true}) {
        TourOptions options;
        options.fixed_start = fixed;
        options.kicks = 200;
        const ImprovedTour tour = improve_tour(points, order, options);
        expect_sound(tour, points, order);
        if (fixed) {
          EXPECT_EQ(tour.order.front(), order.front());
        }
        const double best = shortest(points, order, fixed);
        EXPECT_GE(tour.length_after, best * (1.0 - 1e-12));
        optimal += tour.length_after <= best * (1.0 + 1e-9);
        ++cases;
      }
    }
  }
  EXPECT_GE(optimal, cases * 9 / 10);
}

TEST(TourImprovement, ShortensRandomPathsOfManySizesWithEitherStart) {
  std::mt19937 random(6);
  for (const std::size_t n : {9u, 17u, 60u, 333u, 1500u}) {
    const std::vector<Point> points = scattered(n, random);
    const std::vector<Index> order = shuffled(n, random);
    for (const bool fixed : {false, true}) {
      TourOptions options;
      options.fixed_start = fixed;
      const ImprovedTour tour = improve_tour(points, order, options);
      expect_sound(tour, points, order);
      EXPECT_LT(tour.length_after, tour.length_before);
      EXPECT_GT(tour.moves, 0);
      EXPECT_EQ(tour.kicks, static_cast<Index>(n));
      if (fixed) {
        EXPECT_EQ(tour.order.front(), order.front());
      }
      // Beardwood, Halton and Hammersley 1959: a shortest tour has about 0.7124 sqrt(n area); small n have more rim.
      if (n > 1000) {
        EXPECT_LE(tour.length_after, 1.12 * 0.7124 * std::sqrt(static_cast<double>(n) * 270.0));
      }
    }
  }
}

TEST(TourImprovement, EndsNearThePitchOnIslandsOfALattice) {
  const std::vector<Point> points = islands(70, 90, 0.0);
  const std::vector<Index> order = greedy(points);
  const ImprovedTour tour = improve_tour(points, order);
  expect_sound(tour, points, order);
  const double least = 0.3 * static_cast<double>(points.size() - 1);
  EXPECT_GE(tour.length_before, 1.15 * least);
  EXPECT_LE(tour.length_after, 1.06 * least);
  EXPECT_GE(tour.length_after, (1.0 - 1e-9) * least);
  TourOptions local;
  local.kicks = 0;
  EXPECT_LT(tour.length_after, improve_tour(points, order, local).length_after);
}

TEST(TourImprovement, SameBytesForTheSameSeedAndOthersForAnother) {
  const std::vector<Point> points = islands(40, 50, 0.1);
  TourOptions options;
  options.seed = 7;
  const ImprovedTour first = improve_tour(points, in_order(points.size()), options);
  const ImprovedTour again = improve_tour(points, in_order(points.size()), options);
  EXPECT_EQ(first.order, again.order);
  EXPECT_EQ(first.length_after, again.length_after);
  EXPECT_EQ(first.kicks_kept, again.kicks_kept);
  options.seed = 8;
  EXPECT_NE(first.order, improve_tour(points, in_order(points.size()), options).order);
}

TEST(TourImprovement, CollinearPointsComeIntoALine) {
  std::mt19937 random(11);
  std::vector<Point> points;
  for (int k = 0; k < 60; ++k) points.push_back({0.75 * k - 9.0, 3.0 - 0.25 * k});
  const std::vector<Index> order = shuffled(points.size(), random);
  const ImprovedTour tour = improve_tour(points, order);
  expect_sound(tour, points, order);
  EXPECT_NEAR(tour.length_after, distance(points.front(), points.back()), 1e-9);
}

TEST(TourImprovement, DuplicatesAreVisitedTogether) {
  std::mt19937 random(12);
  std::vector<Point> points(40, Point{2.0, -1.0});
  const ImprovedTour still = improve_tour(points, shuffled(40, random));
  expect_sound(still, points, in_order(40));
  EXPECT_EQ(still.length_after, 0.0);
  for (std::size_t k = 0; k < points.size(); ++k) points[k].x += static_cast<double>(k % 4);  // 4 heaps of 10
  const std::vector<Index> order = in_order(40);
  const ImprovedTour tour = improve_tour(points, order);
  expect_sound(tour, points, order);
  EXPECT_LT(tour.length_after, 0.5 * tour.length_before);
  const std::vector<Point> heap(20000, Point{1.0, 1.0});  // no search may look through all duplicates for each
  EXPECT_EQ(improve_tour(heap, in_order(heap.size())).length_after, 0.0);
}

TEST(TourImprovement, LeavesAShortestPathAsItIs) {
  std::vector<Point> points;
  for (int k = 0; k < 30; ++k) points.push_back({k < 15 ? 0.1 * k : 0.1 * (29 - k), k < 15 ? 0.0 : 0.1});
  const ImprovedTour tour = improve_tour(points, in_order(points.size()));
  EXPECT_EQ(tour.order, in_order(points.size()));
  EXPECT_EQ(tour.length_after, tour.length_before);
}

TEST(TourImprovement, ScaleAndPlaceDoNotMatter) {
  const std::vector<Point> points = islands(20, 30, 0.0);
  const ImprovedTour here = improve_tour(points, in_order(points.size()));
  std::vector<Point> moved;
  for (const Point p : points) moved.push_back({0x1p-40 * p.x, 0x1p-40 * p.y});  // exact
  const ImprovedTour small = improve_tour(moved, in_order(points.size()));
  EXPECT_EQ(small.order, here.order);
}

TEST(TourImprovement, StopsWhenToldTo) {
  std::mt19937 random(13);
  const std::vector<Point> points = scattered(5000, random);
  const std::vector<Index> order = shuffled(points.size(), random);
  TourOptions options;
  int asked = 0;
  options.stop = [&] { return ++asked >= 2; };
  const ImprovedTour tour = improve_tour(points, order, options);
  expect_sound(tour, points, order);
  EXPECT_TRUE(tour.stopped);
  EXPECT_EQ(tour.kicks, 0);
  EXPECT_EQ(asked, 2);
  options.stop = [] { return false; };
  options.kicks = 300;
  const ImprovedTour whole = improve_tour(points, order, options);
  EXPECT_FALSE(whole.stopped);
  EXPECT_EQ(whole.kicks, 300);
  EXPECT_LT(whole.length_after, tour.length_after);
}

TEST(TourImprovement, RefusesWhatIsNoTour) {
  const auto message = [](const std::vector<Point>& points, const std::vector<Index>& order, Index kicks = 1) {
    TourOptions options;
    options.kicks = kicks;
    return message_of([&] { improve_tour(points, order, options); });
  };
  EXPECT_EQ(message({}, {}), "tour: no points; at least one is required");
  EXPECT_EQ(message({{0, 1}, {2, kNaN}}, {0, 1}), "tour: point 2 is (2, nan); required finite");
  EXPECT_EQ(message({{-kInf, 1}}, {0}), "tour: point 1 is (-inf, 1); required finite");
  EXPECT_EQ(message({{-1e308, 0}, {1e308, 0}}, {0, 1}),
            "tour: the points reach from (-1e+308, 0) to (1e+308, 0); required a finite distance");
  EXPECT_EQ(message({{0, 1}, {2, 3}}, {0}), "tour: the order has 1 entries for 2 points; required one each");
  for (const Index bad : {-1, 0, 2}) {
    EXPECT_EQ(message({{0, 1}, {2, 3}}, {0, bad}), "tour: the order has the index " + std::to_string(bad) +
                                                       " twice or outside 0 to 1; required every point once");
  }
  EXPECT_EQ(message({{0, 1}}, {0}, -1), "tour: kicks = -1; required >= 0");
}

}  // namespace
}  // namespace dwell
