#include "core/anatomy/blemishes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include "core/anatomy/surroundings.h"
#include "core/base/random_numbers.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();
constexpr double kWidth = 3.0;  // of the tool [mm]

const Grid kGrid{150, 170, 0.2, 0.16, {-5.0, 2.0}};

/// Noise of 1 nm, a ripple of 1 nm that runs askew, a tilt, and edges that rise by 50 nm within a millimetre.
HeightMap clean_map(RandomNumbers& random, const Grid& grid = kGrid) {
  HeightMap map(grid);
  const double turn = 2.0 * std::numbers::pi * random.uniform(), wave = 0.6 + 2.0 * random.uniform();
  const double right = grid.x(grid.cols - 1), top = grid.y(grid.rows - 1);
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    const double phase = 2.0 * std::numbers::pi * (std::cos(turn) * p.x + std::sin(turn) * p.y) / wave;
    const double from_edge = std::min({p.x - grid.origin.x, right - p.x, p.y - grid.origin.y, top - p.y});
    map.values[static_cast<std::size_t>(i)] =
        random.normal() + std::sin(phase) + 3.0 * p.x - 5.0 * p.y + 50.0 * std::exp(-3.0 * from_edge);
  }
  return map;
}

struct Pit {
  Point place;
  double radius, height;
};

void add_pit(HeightMap& map, const Pit& pit) {
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (distance(map.grid.centre(i), pit.place) < pit.radius) map.values[static_cast<std::size_t>(i)] += pit.height;
  }
}

double sorted_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// What surroundings say, from their definition: all pairs of the ways that both have data.
std::optional<Deviation> slow_deviation(const HeightMap& map, const Surroundings& around, Index all_round, Index row,
                                        Index col) {
  std::vector<double> halves;
  const auto means = [&](Index from, Index to, Index most) {
    std::vector<double> pairs;
    halves.clear();
    for (Index k = from; k < to && static_cast<Index>(pairs.size()) < most; ++k) {
      const auto [rows, cols] = around.ways()[static_cast<std::size_t>(k)];
      const auto value = [&](Index r, Index c) {
        return r < 0 || c < 0 || r >= map.grid.rows || c >= map.grid.cols ? kNoData : map.at(r, c);
      };
      const double one = value(row + rows, col + cols), other = value(row - rows, col - cols);
      if (std::isnan(one) || std::isnan(other)) continue;
      pairs.push_back(0.5 * (one + other));
      halves.push_back(0.5 * std::abs(one - other));
    }
    return pairs;
  };
  if (std::isnan(map.at(row, col))) return std::nullopt;
  const auto all = static_cast<Index>(around.ways().size());
  std::vector<double> pairs = means(0, std::min<Index>(96, all_round), 64);
  if (pairs.size() < 64) pairs = means(all_round, all, 64);
  if (pairs.size() < 12) {
    const Index some = std::min<Index>(96, all_round);
    pairs = means(0, some, 64);
    if (static_cast<Index>(pairs.size()) < std::max<Index>(12, some / 4)) return std::nullopt;
  }
  Deviation d;
  d.middle = sorted_median(pairs);
  d.height = map.at(row, col) - d.middle;
  for (double& p : pairs) p = std::abs(p - d.middle);
  d.sigma = std::sqrt(2.0) * 1.4826 * sorted_median(pairs);
  d.step = sorted_median(halves);
  return d;
}

/// How many ways lead all round: those along the row and the column follow, the first of them along the row.
Index ways_all_round(const Surroundings& around) {
  const auto& ways = around.ways();
  auto k = ways.size();
  while (k > 0 && ways[k - 1].cols == 0) --k;
  while (k > 0 && ways[k - 1].rows == 0 && (k < 2 || ways[k - 2].cols == ways[k - 1].cols - 1)) --k;
  return static_cast<Index>(k == 0 ? 0 : k - 1);
}

TEST(Surroundings, AreThoseOfTheDefinition) {
  RandomNumbers random(3);
  HeightMap map = clean_map(random, {40, 46, 0.2, 0.16, {}});
  for (Index row = 10; row < 17; ++row) map.at(row, 30) = map.at(row, 31) = kNoData;
  const Surroundings around(map, kWidth);
  const Index all_round = ways_all_round(around);
  Index known = 0;
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const auto slow = slow_deviation(map, around, all_round, row, col), fast = around.deviation(row, col);
      ASSERT_EQ(slow.has_value(), fast.has_value()) << row << " " << col;
      if (!slow) continue;
      ++known;
      EXPECT_EQ(slow->middle, fast->middle) << row << " " << col;
      EXPECT_DOUBLE_EQ(slow->sigma, fast->sigma);
      EXPECT_EQ(slow->height, fast->height);
      EXPECT_EQ(slow->step, fast->step);
    }
  }
  EXPECT_GT(known, map.grid.size() / 2);
}

TEST(Surroundings, AreTheSameByGlanceForARowAsForAPixel) {
  RandomNumbers random(4);
  HeightMap map = clean_map(random);
  map.at(70, 80) = kNoData;
  for (const double reach : {1.0, kWidth}) {
    const Surroundings around(map, reach);
    std::vector<double> heights(static_cast<std::size_t>(kGrid.cols)), sigmas = heights;
    for (Index row = 0; row < kGrid.rows; row += 7) {
      around.glance_at_row(row, heights, sigmas);
      for (Index col = 0; col < kGrid.cols; ++col) {
        const auto one = around.glance(row, col);
        const auto i = static_cast<std::size_t>(col);
        ASSERT_EQ(one.has_value(), std::isfinite(heights[i])) << row << " " << col;
        ASSERT_EQ(one.has_value(), std::isfinite(sigmas[i])) << row << " " << col;
        if (!one) continue;
        ASSERT_EQ(one->height, heights[i]) << row << " " << col;
        ASSERT_EQ(one->sigma, sigmas[i]) << row << " " << col;
      }
    }
  }
}

TEST(Surroundings, KnowTheNoise) {
  RandomNumbers random(5);
  HeightMap map(kGrid);
  for (double& v : map.values) v = random.normal();
  const Surroundings around(map, kWidth);
  double deviation = 0.0, glance = 0.0;
  Index count = 0;
  for (Index row = 30; row < 120; row += 3) {
    for (Index col = 30; col < 140; col += 3, ++count)
      deviation += around.deviation(row, col)->sigma, glance += around.glance(row, col)->sigma;
  }
  EXPECT_NEAR(deviation / static_cast<double>(count), 1.0, 0.05);
  EXPECT_NEAR(glance / static_cast<double>(count), 1.0, 0.1);
}

bool in_corner(Point p) {
  const double right = kGrid.x(kGrid.cols - 1), top = kGrid.y(kGrid.rows - 1);
  return std::min(p.x - kGrid.origin.x, right - p.x) < kWidth && std::min(p.y - kGrid.origin.y, top - p.y) < kWidth;
}

/// Pits anywhere on the map, also at its edge, a tool's width apart. Not in its corners, where all pairs reach into an
/// edge.
std::vector<Pit> random_pits(RandomNumbers& random, std::uint32_t count) {
  std::vector<Pit> pits;
  while (pits.size() < count) {
    const double radius = 0.1 + 0.6 * random.uniform(), sign = random.below(2) == 0 ? 1.0 : -1.0;
    const Pit pit{{kGrid.origin.x + 0.8 + random.uniform() * (kGrid.width() - 1.8),
                   kGrid.origin.y + 0.8 + random.uniform() * (kGrid.height() - 1.8)},
                  radius,
                  sign * 60.0 * std::exp(3.0 * random.uniform())};
    if (!in_corner(pit.place) &&
        std::all_of(pits.begin(), pits.end(), [&](const Pit& p) { return distance(p.place, pit.place) > kWidth; }))
      pits.push_back(pit);
  }
  return pits;
}

std::string places_of(const std::vector<Blemish>& found) {
  std::string text;
  for (const Blemish& b : found) text += fmt::format("({:.3g}, {:.3g}) {:.3g} nm; ", b.place.x, b.place.y, b.height);
  return text;
}

TEST(Blemishes, AreFoundOnAHundredMapsAndNoOthers) {
  RandomNumbers random(1);
  Index made = 0;
  for (int k = 0; k < 100; ++k) {
    HeightMap map = clean_map(random);
    const std::vector<Pit> pits = random_pits(random, random.below(6));
    for (const Pit& pit : pits) add_pit(map, pit);
    const std::vector<Blemish> found = find_blemishes(map, {kWidth}, 2);
    made += static_cast<Index>(pits.size());
    EXPECT_EQ(found.size(), pits.size()) << k << ": " << places_of(found);
    for (const Pit& pit : pits) {
      const auto same = std::find_if(found.begin(), found.end(),
                                     [&](const Blemish& b) { return distance(b.place, pit.place) < 0.2; });
      EXPECT_NE(same, found.end()) << k << ": none at " << pit.place.x << ", " << pit.place.y << ", radius "
                                   << pit.radius << ", " << pit.height;
      if (same == found.end()) continue;
      EXPECT_NEAR(same->height, pit.height, 8.0 + 0.2 * std::abs(pit.height)) << k;
      EXPECT_NEAR(same->length, 2.0 * pit.radius, 0.45) << k;
      EXPECT_NEAR(same->width, 2.0 * pit.radius, 0.45) << k;
    }
  }
  EXPECT_GT(made, 200);
}

TEST(Blemishes, HaveTheirPixelsAndTheLevelAround) {
  RandomNumbers random(2);
  HeightMap map(kGrid);
  for (double& v : map.values) v = 0.1 * random.normal() + 7.0;
  const HeightMap before = map;
  add_pit(map, {{10.0, 12.0}, 0.5, -60.0});
  const std::vector<Blemish> found = find_blemishes(map, {kWidth});
  ASSERT_EQ(found.size(), 1u);
  std::vector<Index> pixels;
  for (Index i = 0; i < kGrid.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (map.values[k] != before.values[k]) pixels.push_back(i);
  }
  EXPECT_EQ(found[0].pixels, pixels);
  for (const double level : found[0].level) EXPECT_NEAR(level, 7.0, 0.1);
  const HeightMap without = without_blemishes(map, found);
  EXPECT_EQ(without.valid_pixels(), kGrid.size() - static_cast<Index>(pixels.size()));
}

TEST(Blemishes, AreScratchesHoweverLongButNoHills) {
  RandomNumbers random(6);
  HeightMap map(kGrid);
  for (double& v : map.values) v = random.normal();
  for (Index k = 20; k < 140; ++k) map.at(k, 20 + k / 2) -= 30.0, map.at(k, 21 + k / 2) -= 30.0;
  add_pit(map, {{22.0, 14.0}, kWidth, 30.0});  // twice as wide as the tool
  const std::vector<Blemish> found = find_blemishes(map, {kWidth}, 2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].length, 20.0);
  EXPECT_LT(found[0].width, 1.0);
  EXPECT_NEAR(found[0].height, -31.0, 4.0);
}

TEST(Blemishes, AreNoneOnSmoothSurfacesWithoutNoise) {
  HeightMap flat(kGrid), smooth(kGrid);
  for (Index i = 0; i < kGrid.size(); ++i) {
    const Point p = kGrid.centre(i);
    const auto k = static_cast<std::size_t>(i);
    flat.values[k] = 0.1;
    smooth.values[k] = p.x * p.x - 3.0 * p.y + 100.0 * std::exp(-2.0 * (p.x + 5.0)) + std::sin(p.y);
  }
  EXPECT_TRUE(find_blemishes(flat, {kWidth}).empty());
  EXPECT_TRUE(find_blemishes(smooth, {kWidth}).empty());
  add_pit(flat, {{3.0, 8.0}, 0.4, -1.0});
  EXPECT_EQ(find_blemishes(flat, {kWidth}).size(), 1u);
}

TEST(Blemishes, AreNoSteps) {
  RandomNumbers random(10);
  HeightMap map(kGrid);
  for (Index i = 0; i < kGrid.size(); ++i) {
    const Point p = kGrid.centre(i);
    map.values[static_cast<std::size_t>(i)] = random.normal() + (p.x + 0.3 * p.y > 14.0 ? 50.0 : 0.0);
  }
  EXPECT_TRUE(find_blemishes(map, {kWidth}).empty());
}

TEST(Blemishes, AreTheSameForAnyNumberOfThreads) {
  RandomNumbers random(7);
  HeightMap map = clean_map(random);
  for (const Pit& pit : random_pits(random, 5)) add_pit(map, pit);
  const auto one = find_blemishes(map, {kWidth}, 1), three = find_blemishes(map, {kWidth}, 3);
  ASSERT_EQ(one.size(), 5u);
  ASSERT_EQ(three.size(), 5u);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].pixels, three[k].pixels);
}

TEST(Blemishes, ComeInTheOrderOfTheirSquares) {
  HeightMap map(kGrid);
  RandomNumbers random(8);
  for (double& v : map.values) v = random.normal();
  add_pit(map, {{0.0, 8.0}, 0.3, 40.0});
  add_pit(map, {{10.0, 18.0}, 0.3, -400.0});
  const auto found = find_blemishes(map, {kWidth});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(found[0].height, -300.0);
}

TEST(Blemishes, OfAFitAreNotWhatItMakesAroundThem) {
  RandomNumbers random(15);
  HeightMap map(kGrid);
  for (double& v : map.values) v = random.normal();
  add_pit(map, {{0.0, 8.0}, 0.3, -400.0});
  add_pit(map, {{1.2, 8.6}, 0.3, 40.0});     // beside it, on the other side
  add_pit(map, {{14.0, 18.0}, 0.3, 40.0});   // far from it
  add_pit(map, {{-0.5, 10.0}, 0.3, -40.0});  // beside it, on the same side
  EXPECT_EQ(find_blemishes(map, {kWidth}).size(), 4u);
  const auto found = find_blemishes(map, {.width = kWidth, .of_fit = true});
  ASSERT_EQ(found.size(), 3u);
  for (const Blemish& b : found) EXPECT_GT(distance(b.place, {1.2, 8.6}), 1.0);
}

TEST(Blemishes, RefuseOptionsOutOfRange) {
  const HeightMap map(kGrid);
  for (const double wrong : {0.0, -1.0, kNoData, std::numeric_limits<double>::infinity()}) {
    expect_input_error([&] { find_blemishes(map, {wrong}); }, {"width", "a finite number > 0"});
    expect_input_error([&] { find_blemishes(map, {1.0, wrong}); }, {"sigmas", "a finite number > 0"});
  }
}

TEST(Blemishes, StopWhenAskedTo) {
  RandomNumbers random(9);
  const HeightMap map = clean_map(random);
  Progress progress;
  progress.stop = [] { return true; };
  EXPECT_THROW(find_blemishes(map, {kWidth}, 1, progress), Interrupted);
}

TEST(BlemishWidth, IsThatOfTheThickestPlace) {
  const Grid grid{60, 60, 0.5, 0.25, {}};
  std::set<Index> disc, line, angle;
  for (Index r = 0; r < 60; ++r) {
    for (Index c = 0; c < 60; ++c) {
      if (distance(grid.centre(r, c), {15.0, 7.0}) < 4.0) disc.insert(grid.index(r, c));
      if (r == 30 || r == 31) line.insert(grid.index(r, c));
      if ((r == 30 && c >= 5) || (c == 5 && r >= 30)) angle.insert(grid.index(r, c));
    }
  }
  const auto width = [&](const std::set<Index>& pixels) {
    return blemish_width(grid, std::vector<Index>(pixels.begin(), pixels.end()));
  };
  EXPECT_NEAR(width(disc), 8.0, 0.8);
  EXPECT_DOUBLE_EQ(width(line), 0.5);
  EXPECT_LE(width(angle), 0.57);
  EXPECT_EQ(width({}), 0.0);
  EXPECT_DOUBLE_EQ(width({7}), 0.25);
}

}  // namespace
}  // namespace dwell
