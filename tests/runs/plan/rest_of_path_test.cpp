#include "runs/plan/rest_of_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "paths/feed/stroke_moves.h"

namespace dwell {
namespace {

/// Where a run along strokes is after a time, by walking.
Point place_at(const std::vector<Stroke>& strokes, const std::vector<double>& dwell, double seconds) {
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (seconds > dwell[j] && j + 1 < strokes.size()) {
      seconds -= dwell[j];
      continue;
    }
    const Stroke& s = strokes[j];
    double way = std::min(1.0, seconds / dwell[j]) * s.length();
    const double first = distance(s.start, s.via);
    const Point from = way <= first ? s.start : s.via, to = way <= first ? s.via : s.finish;
    if (way > first) way -= first;
    const double whole = distance(from, to);
    return whole > 0.0 ? from + (way / whole) * (to - from) : to;
  }
  return {};
}

/// The tool must be at the same places at the same times as in the whole run, of the strokes that are uneven within
/// `blur` mm.
void expect_goes_on(const ToolPath& path, const std::vector<double>& dwell, std::size_t stroke, double done,
                    double blur) {
  const RestOfPath rest = rest_of_path(path, dwell, Motion::Moving, stroke, done, 1e6);
  const auto whole = strokes_of(path, Motion::Moving), now = strokes_of(rest.path, Motion::Moving);
  const double before =
      std::accumulate(dwell.begin(), dwell.begin() + static_cast<std::ptrdiff_t>(stroke), done * dwell[stroke]);
  const double left = std::accumulate(dwell.begin(), dwell.end(), 0.0) - before;
  EXPECT_NEAR(std::accumulate(rest.dwell.begin(), rest.dwell.end(), 0.0), left, 1e-9);
  for (int k = 0; k < 200; ++k) {
    const double t = left * (k + 0.37) / 200.0;
    EXPECT_LE(distance(place_at(now, rest.dwell, t), place_at(whole, dwell, before + t)), blur)
        << stroke << " " << done;
  }
}

std::vector<double> uneven_dwell(std::size_t n) {
  std::vector<double> dwell(n);
  for (std::size_t j = 0; j < n; ++j) dwell[j] = 1.0 + 0.4 * std::sin(2.1 * static_cast<double>(j));
  return dwell;
}

TEST(RestOfPath, GoesOnAlongAStraightLineFromAnywhere) {
  ToolPath path{"file", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}, {1, 0, 0, 0, 0}};
  for (const double done : {0.0, 0.2, 0.5, 0.8, 0.99})
    for (const std::size_t j : {0u, 2u, 4u}) expect_goes_on(path, uneven_dwell(5), j, done, 1e-6);
}

TEST(RestOfPath, GoesOnAroundCornersOfUnevenSteps) {
  ToolPath path{"file", {{0, 0}, {1, 0.3}, {1.2, 1.4}, {3, 1}, {3.5, -0.6}, {2, -1}}, {1, 0, 0, 0, 0, 0}};
  for (const std::size_t j : {0u, 1u, 2u, 3u, 4u, 5u}) {
    for (const double done : {0.0, 0.1, 0.3}) expect_goes_on(path, uneven_dwell(6), j, done, 1e-6);
    // Beyond the point the next one begins at a corner as well: the speeds of two strokes mix over a part of them.
    for (const double done : {0.6, 0.9}) expect_goes_on(path, uneven_dwell(6), j, done, 0.25);
  }
}

TEST(RestOfPath, GoesOnAlongAChainOfEqualStepsAndOverLifts) {
  ToolPath chain{"random", {}, {}};
  Point node{0, 0};
  for (int k = 0; k < 8; ++k) {
    const Point next = node + Point{std::cos(0.9 * k), std::sin(0.9 * k)};
    chain.points.push_back(0.5 * (node + next));
    chain.lifted.push_back(k == 0 ? 1 : 0);
    node = next;
  }
  for (const double done : {0.0, 0.3, 0.7})
    for (const std::size_t j : {1u, 4u, 7u}) expect_goes_on(chain, uneven_dwell(8), j, done, done > 0.5 ? 0.25 : 1e-6);
  ToolPath lifted{"file", {{0, 0}, {1, 0}, {1.5, 1}, {9, 9}, {9, 8}}, {1, 0, 0, 1, 0}};
  for (const double done : {0.0, 0.4, 0.7}) expect_goes_on(lifted, uneven_dwell(5), 2, done, 1e-6);
}

TEST(RestOfPath, OfHaltsKeepsTheTimeThatIsLeft) {
  const ToolPath path{"file", {{0, 0}, {1, 0}, {2, 1}}, {1, 0, 0}};
  const RestOfPath rest = rest_of_path(path, {1.0, 2.0, 3.0}, Motion::Stop, 1, 0.25, 10.0);
  EXPECT_EQ(rest.path.points, (std::vector<Point>{{1, 0}, {2, 1}}));
  EXPECT_EQ(rest.path.lifted, (std::vector<char>{1, 0}));
  EXPECT_EQ(rest.dwell, (std::vector<double>{1.5, 3.0}));
}

}  // namespace
}  // namespace dwell
