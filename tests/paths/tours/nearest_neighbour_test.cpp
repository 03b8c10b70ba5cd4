#include "paths/tours/nearest_neighbour.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "paths/metrics/path_metrics.h"
#include "paths/tours/spanning_tree.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::kInf;
using test::kNaN;
using test::map_from_picture;

NearestOptions options(double cell) {
  NearestOptions o;
  o.cell = cell;
  o.critical = -kInf;
  return o;
}

/// The rule as it stands in the paper, O(n^2), on maps whose pixels are the cells (pitch = cell = 1).
std::vector<Point> oracle(const HeightMap& map, double critical) {
  struct Place {
    long x, y;
    double m;
    bool done;
  };
  std::vector<Place> places;
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (map.at(row, col) >= critical) places.push_back({col, row, map.at(row, col), false});
    }
  }
  std::vector<Point> order;
  std::size_t now = 0;
  while (true) {
    places[now].done = true;
    order.push_back({static_cast<double>(places[now].x), static_cast<double>(places[now].y)});
    bool found = false;
    std::size_t next = 0;
    long next_d = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (places[k].done) continue;
      const long dx = places[k].x - places[now].x, dy = places[k].y - places[now].y, d = dx * dx + dy * dy;
      if (!found || d < next_d || (d == next_d && places[k].m > places[next].m)) {
        found = true;
        next = k;
        next_d = d;
      }
    }
    if (!found) return order;
    now = next;
  }
}

void expect_as_oracle(const HeightMap& map, double critical) {
  NearestOptions o = options(1.0);
  o.critical = critical;
  const NearestPath result = nearest_path(map, o);
  const std::vector<Point> expected = oracle(map, critical);
  ASSERT_EQ(result.path.size(), expected.size());
  ASSERT_EQ(result.eigenvalues.size(), expected.size());
  for (std::size_t j = 0; j < expected.size(); ++j) {
    ASSERT_NEAR(result.path.points[j].x, expected[j].x, 1e-12) << j;
    ASSERT_NEAR(result.path.points[j].y, expected[j].y, 1e-12) << j;
    ASSERT_EQ(result.eigenvalues[j], map.at(static_cast<Index>(expected[j].y), static_cast<Index>(expected[j].x)));
    if (j > 0) {
      const bool far = distance(expected[j - 1], expected[j]) > 1.5;
      ASSERT_EQ(result.path.lifted[j] != 0, far) << j;
    }
  }
}

TEST(Nearest, AgreesWithTheOracleOnRandomMaps) {
  std::mt19937 random(3);
  for (const double hole : {0.0, 0.1, 0.5, 0.95}) {
    for (const int levels : {1, 3, 1000000}) {
      HeightMap map(Grid{37, 53, 1.0, 1.0, {}});
      std::uniform_int_distribution<int> level(0, levels - 1);
      std::bernoulli_distribution empty(hole);
      for (double& v : map.values) {
        const double value = level(random);
        if (!empty(random)) v = value;
      }
      map.at(0, 0) = map.at(36, 52) = 0.0;  // the bounding box keeps its place
      expect_as_oracle(map, -kInf);
    }
  }
}

TEST(Nearest, AgreesWithTheOracleOnSmoothMapsWithACriticalValue) {
  HeightMap map = full_map(48, 64);
  for (Index row = 0; row < 48; ++row) {
    for (Index col = 0; col < 64; ++col) {
      const double x = static_cast<double>(col), y = static_cast<double>(row);
      map.at(row, col) = 40.0 * std::sin(0.21 * x) * std::cos(0.17 * y + 0.05 * x) + 5.0 * std::sin(1.9 * x * y);
    }
  }
  expect_as_oracle(map, 0.0);
  expect_as_oracle(map, 20.0);
}

/// Rings, combs and far islands: the walk finishes large areas and then has to look across them.
std::vector<HeightMap> adversarial_maps(Index n) {
  std::vector<HeightMap> maps(4, HeightMap(Grid{n, n, 1.0, 1.0, {}}));
  for (Index row = 0; row < n; ++row) {
    for (Index col = 0; col < n; ++col) {
      const double r = std::hypot(static_cast<double>(row) - 0.5 * static_cast<double>(n),
                                  static_cast<double>(col) - 0.5 * static_cast<double>(n));
      if (static_cast<Index>(r) % 7 == 0) maps[0].at(row, col) = static_cast<double>(row % 2);
      if (col % 4 == 0 || row == 0) maps[1].at(row, col) = 1.0;
      if ((row < n / 8 || row >= n - n / 8) && (col < n / 8 || col >= n - n / 8)) maps[2].at(row, col) = 1.0;
      if (std::min(row, col) == 0 || std::max(row, col) == n - 1 || (row % 11 == 5 && col % 13 == 6)) {
        maps[3].at(row, col) = static_cast<double>((row * 31 + col * 17) % 5);
      }
    }
  }
  return maps;
}

TEST(Nearest, AgreesWithTheOracleOnAdversarialMaps) {
  for (HeightMap map : adversarial_maps(64)) {
    map.at(0, 0) = map.at(63, 63) = 1.0;
    expect_as_oracle(map, -kInf);
  }
}

TEST(Nearest, SearchWorkPerPointStaysSmall) {
  for (const Index n : {64, 256, 512}) {
    std::vector<HeightMap> maps = adversarial_maps(n);
    maps.push_back(full_map(n, n));
    for (const HeightMap& map : maps) {
      const NearestPath result = nearest_path(map, options(1.0));
      // A descent looks into at most 4 blocks a level where nothing has to be revisited; there are log2(n) levels.
      const double per_point = static_cast<double>(result.blocks_searched) / static_cast<double>(result.path.size());
      EXPECT_LE(per_point, 6.0 * std::log2(static_cast<double>(n)));
    }
  }
}

TEST(Nearest, VisitsEveryCellOnceOnAMillionPoints) {
  std::mt19937 random(9);
  std::normal_distribution<double> height(0.0, 10.0);
  HeightMap map = full_map(1000, 1000);
  for (double& v : map.values) v = height(random);
  const NearestPath result = nearest_path(map, options(1.0));
  ASSERT_EQ(result.path.size(), 1000000u);
  std::vector<char> seen(1000000, 0);
  for (const Point p : result.path.points)
    seen[static_cast<std::size_t>(std::lround(p.y) * 1000 + std::lround(p.x))] = 1;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 1000000);
  EXPECT_LE(static_cast<double>(result.blocks_searched), 60e6);
}

TEST(Nearest, AmongEquallyNearTheHighestThenTheLowestIndex) {
  // From the lower left corner both neighbours are 1 away: up is higher. Then right and left tie in value: lower index.
  const NearestPath climb = nearest_path(map_from_picture({"31", "21", "11"}), options(1.0));
  EXPECT_EQ(climb.path.points[1], (Point{0, 1}));
  EXPECT_EQ(climb.path.points[2], (Point{0, 2}));
  NearestOptions o = options(1.0);
  o.start = Point{1, 1};
  const NearestPath tie = nearest_path(map_from_picture({"111", "111", "111"}), o);
  EXPECT_EQ(tie.path.points[0], (Point{1, 1}));
  EXPECT_EQ(tie.path.points[1], (Point{1, 0}));
  EXPECT_EQ(tie.path.points[2], (Point{0, 0}));
}

TEST(Nearest, CellsCoverTheValidPixelsCentredAndAverageThem) {
  // Valid pixels: columns 2..6 (5 mm wide), rows 1..2 (2 mm high): 3 x 1 cells of 2 mm, from x = 1 to 7 (box 1.5
  // to 6.5).
  HeightMap map(Grid{4, 9, 1.0, 1.0, {}});
  for (Index col = 2; col <= 6; ++col) {
    map.at(1, col) = static_cast<double>(col);
    map.at(2, col) = static_cast<double>(col) + 10.0;
  }
  map.at(2, 2) = kNaN;
  const NearestPath result = nearest_path(map, options(2.0));
  ASSERT_EQ(result.path.size(), 3u);
  EXPECT_EQ(result.cells_total, 3);
  EXPECT_DOUBLE_EQ(result.path.points[0].x, 2.0);
  EXPECT_DOUBLE_EQ(result.path.points[0].y, 1.5);
  EXPECT_DOUBLE_EQ(result.path.points[2].x, 6.0);
  // Pixel centres on the common edges x = 3 and 5 belong to the right cell.
  EXPECT_DOUBLE_EQ(result.eigenvalues[0], 2.0);
  EXPECT_DOUBLE_EQ(result.eigenvalues[1], (3.0 + 4.0 + 13.0 + 14.0) / 4.0);
  EXPECT_DOUBLE_EQ(result.eigenvalues[2], (5.0 + 6.0 + 15.0 + 16.0) / 4.0);
}

TEST(Nearest, CriticalValueKeepsCellsThatReachIt) {
  const HeightMap map = map_from_picture({"123", "456"});
  NearestOptions o = options(1.0);
  o.critical = 3.0;
  const NearestPath result = nearest_path(map, o);
  EXPECT_EQ(result.path.size(), 4u);
  EXPECT_EQ(result.cells_total, 6);
  o.critical = 6.5;
  EXPECT_EQ(test::message_of([&] { nearest_path(map, o); }),
            "nearest: critical = 6.5 nm keeps no cell; the highest mean of the 6 cells is 6 nm");
}

TEST(Nearest, JumpsAreLiftedBeyondTheLimit) {
  const HeightMap map = map_from_picture({"1..11...1"});
  NearestOptions o = options(1.0);
  EXPECT_EQ(nearest_path(map, o).path.lifted, (std::vector<char>{1, 1, 0, 1}));
  o.lift = 3.0;  // a jump of exactly 3 cells is not longer than 3
  EXPECT_EQ(nearest_path(map, o).path.lifted, (std::vector<char>{1, 0, 0, 1}));
  o.lift = kInf;
  EXPECT_EQ(nearest_path(map, o).path.lifted, (std::vector<char>{1, 0, 0, 0}));
}

TEST(Nearest, APointAloneIsAHaltAndAFullRowHasTheSerpentinesLength) {
  EXPECT_EQ(path_metrics(nearest_path(map_from_picture({"1"}), options(1.0)).path).length, 0.0);
  const PathMetrics row = path_metrics(nearest_path(full_map(1, 12, 0.5, 0.5), options(0.5)).path);
  EXPECT_NEAR(row.point_length, 11 * 0.5, 1e-12);
}

TEST(Nearest, StartsNearestToTheGivenPointElseLowestAndLeftmost) {
  const HeightMap map = map_from_picture({"111", ".11"});
  NearestOptions o = options(1.0);
  EXPECT_EQ(nearest_path(map, o).path.points[0], (Point{1, 0}));
  o.start = Point{-50.0, 80.0};
  EXPECT_EQ(nearest_path(map, o).path.points[0], (Point{0, 1}));
}

TEST(Nearest, ImprovementReordersTheSameCellsWithTheirEigenvaluesAndLifts) {
  HeightMap map = full_map(40, 55, 0.6, 0.6, {-9.0, 4.0});
  for (Index row = 0; row < 40; ++row) {
    for (Index col = 0; col < 55; ++col) {
      const double x = static_cast<double>(col), y = static_cast<double>(row);
      map.at(row, col) = std::sin(0.5 * x + 0.2 * y) * std::cos(0.45 * y) + 0.3 * std::sin(2.3 * x * y);
    }
  }
  NearestOptions o;
  o.cell = 0.6;
  const NearestPath greedy = nearest_path(map, o);
  EXPECT_TRUE(greedy.path.notes.empty());
  o.improve = true;
  const NearestPath better = nearest_path(map, o);
  const double before = path_metrics(greedy.path).point_length, after = path_metrics(better.path).point_length;
  EXPECT_LT(after, 0.95 * before);
  const double least = spanning_tree_length(better.path.points);
  EXPECT_GE(after, least);
  ASSERT_EQ(better.path.notes.size(), 1u);
  EXPECT_EQ(better.path.notes[0],
            fmt::format("2-opt and Or-opt moves shortened the nearest-neighbour path from {:.6g} to {:.6g} mm; no path "
                        "through its points is shorter than their minimum spanning tree, {:.6g} mm",
                        before, after, least));
  std::set<std::pair<double, double>> places;
  for (std::size_t j = 0; j < better.path.size(); ++j) {
    const Point p = better.path.points[j];
    places.emplace(p.x, p.y);
    const Index col = std::lround((p.x + 9.0) / 0.6), row = std::lround((p.y - 4.0) / 0.6);
    ASSERT_EQ(better.eigenvalues[j], map.at(row, col));
    const bool far = j == 0 || distance(better.path.points[j - 1], p) > 0.6 * 1.5;
    ASSERT_EQ(better.path.lifted[j] != 0, far) << j;
  }
  for (const Point p : greedy.path.points) EXPECT_EQ(places.count({p.x, p.y}), 1u);
  EXPECT_EQ(places.size(), greedy.path.size());
  EXPECT_EQ(nearest_path(map, o).path.points, better.path.points);
}

TEST(Nearest, ImprovementKeepsAStartThatIsGiven) {
  const HeightMap map = full_map(9, 14);
  NearestOptions o = options(1.0);
  o.improve = true;
  o.start = Point{6.2, 4.4};
  const NearestPath result = nearest_path(map, o);
  EXPECT_EQ(result.path.points.front(), (Point{6, 4}));
  EXPECT_EQ(result.path.size(), 126u);
  const NearestPath one = nearest_path(map_from_picture({".7."}), o);
  EXPECT_EQ(one.path.size(), 1u);
}

TEST(Nearest, RefusesBadOptions) {
  const HeightMap map = full_map(4, 4, 0.5, 2.0);
  const auto message = [&](const NearestOptions& o) { return test::message_of([&] { nearest_path(map, o); }); };
  EXPECT_EQ(message(options(0.0)), "nearest: cell = 0 mm; required > 0");
  EXPECT_EQ(message(options(kNaN)), "nearest: cell = nan mm; required > 0");
  EXPECT_EQ(message(options(kInf)), "nearest: cell = inf mm; required finite");
  EXPECT_EQ(message(options(1.0)), "nearest: cell = 1 mm; required >= the map's pixel pitch, 2 mm");
  NearestOptions o = options(2.0);
  o.critical = kNaN;
  EXPECT_EQ(message(o), "nearest: critical = nan nm; required finite, or -inf to keep every cell");
  o = options(2.0);
  o.lift = -1.0;
  EXPECT_EQ(message(o), "nearest: lift = -1; required > 0, or inf to lift never");
  o.lift = kNaN;
  EXPECT_EQ(message(o), "nearest: lift = nan; required > 0, or inf to lift never");
  o = options(2.0);
  o.start = Point{kNaN, 0.0};
  EXPECT_EQ(message(o), "nearest: start = nan/0 mm; required finite");
  EXPECT_EQ(test::message_of([] {
              nearest_path(HeightMap(Grid{2, 2, 1.0, 1.0, {}}), options(1.0));
            }),
            "nearest: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
