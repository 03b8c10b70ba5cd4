#include "paths/lines/run_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

std::vector<LineRun> random_runs(std::mt19937_64& random, Index lines) {
  std::vector<LineRun> runs;
  for (Index line = 0; line < lines; ++line) {
    if (random() % 4 == 0) continue;  // empty lines
    Index at = static_cast<Index>(random() % 9);
    for (std::uint64_t k = random() % 5; k > 0; --k) {
      const Index last = at + static_cast<Index>(random() % 6);
      runs.push_back({line, at, last});
      at = last + 2 + static_cast<Index>(random() % 9);
    }
  }
  return runs;
}

struct Ends {
  double enter_x, enter_y, leave_x, leave_y;
};

Ends ends_of(const LineRun& run, bool backwards, double pitch, double step) {
  const double y = pitch * static_cast<double>(run.line);
  const double first = step * static_cast<double>(run.first), last = step * static_cast<double>(run.last);
  return backwards ? Ends{last, y, first, y} : Ends{first, y, last, y};
}

TEST(RunOrder, WithAnInfiniteLinkVisitsAllWithoutALift) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<LineRun> runs = random_runs(random, 2 + static_cast<Index>(random() % 14));
    for (const double link : {test::kInf, 1e300}) {  // whose square is infinite as well
      const std::vector<OrderedRun> order = order_runs(runs, 0.7, 0.4, link);
      ASSERT_EQ(order.size(), runs.size());
      std::vector<int> visits(runs.size(), 0);
      for (const OrderedRun& o : order) ++visits.at(static_cast<std::size_t>(o.run));
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(runs.size()));
      for (std::size_t k = 1; k < order.size(); ++k) EXPECT_FALSE(order[k].lifted);
    }
  }
}

/// Every choice against all ends of all runs that are left.
TEST(RunOrder, EveryMoveIsToTheNearestEnd) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<LineRun> runs = random_runs(random, 2 + static_cast<Index>(random() % 14));
    const double pitch = 0.7, step = 0.4, link = 2.3;
    const std::vector<OrderedRun> order = order_runs(runs, pitch, step, link);
    ASSERT_EQ(order.size(), runs.size());
    std::vector<bool> visited(runs.size(), false);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto now = static_cast<std::size_t>(order[k].run);
      ASSERT_FALSE(visited[now]);
      visited[now] = true;
      if (k == 0) {
        EXPECT_TRUE(order[0].lifted);
        continue;
      }
      const OrderedRun& before = order[k - 1];
      const LineRun& from_run = runs[static_cast<std::size_t>(before.run)];
      const Ends from = ends_of(from_run, before.backwards, pitch, step);
      const auto move = [&](std::size_t i, bool backwards) {
        const Ends to = ends_of(runs[i], backwards, pitch, step);
        return std::hypot(to.enter_x - from.leave_x, to.enter_y - from.leave_y);
      };
      double nearest = test::kInf, near_neighbour = test::kInf;
      for (std::size_t i = 0; i < runs.size(); ++i) {
        if (visited[i] && i != now) continue;
        const double away = std::min(move(i, false), move(i, true));
        nearest = std::min(nearest, away);
        if (std::abs(runs[i].line - from_run.line) <= 1) near_neighbour = std::min(near_neighbour, away);
      }
      const double taken = move(now, order[k].backwards);
      EXPECT_EQ(order[k].lifted, near_neighbour > link);
      EXPECT_NEAR(taken, order[k].lifted ? nearest : near_neighbour, 1e-12);
    }
  }
}

TEST(RunOrder, SweepsARectangleWithoutALift) {
  std::vector<LineRun> runs;
  for (Index line = 0; line < 20; ++line) runs.push_back({line, 3, 40});
  const std::vector<OrderedRun> order = order_runs(runs, 1.0, 1.0, 2.0);
  for (Index k = 0; k < 20; ++k) {
    EXPECT_EQ(order[static_cast<std::size_t>(k)].run, k);
    EXPECT_EQ(order[static_cast<std::size_t>(k)].backwards, k % 2 == 1);
    EXPECT_EQ(order[static_cast<std::size_t>(k)].lifted, k == 0);
  }
  EXPECT_TRUE(order_runs({}, 1.0, 1.0, 2.0).empty());
}

TEST(RunOrder, AHoleCostsOneLift) {
  std::vector<LineRun> runs;
  for (Index line = 0; line < 30; ++line) {
    if (line < 10 || line >= 20) {
      runs.push_back({line, 0, 40});
    } else {
      runs.push_back({line, 0, 12});
      runs.push_back({line, 25, 40});
    }
  }
  const std::vector<OrderedRun> order = order_runs(runs, 1.0, 1.0, 3.0);
  const auto lifts = std::count_if(order.begin(), order.end(), [](const OrderedRun& r) { return r.lifted; });
  EXPECT_LE(lifts, 2 + 1) << "the first, and one or two for the other side of the hole";
}

}  // namespace
}  // namespace dwell
