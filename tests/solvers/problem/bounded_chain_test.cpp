#include "solvers/problem/bounded_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace dwell {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct RandomChain {
  Vector diagonal, off, room, c;

  /// Squares of differences s_j w_j - s_(j-1) w_(j-1), broken here and there, and on request an upper bound and a
  /// square on every variable.
  RandomChain(Index n, bool upper, double square, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    diagonal = Vector::Constant(n, square);
    off = Vector::Zero(n);
    c.resize(n);
    Vector w(n);
    for (Index j = 0; j < n; ++j) w[j] = 0.5 + u(random);
    for (Index j = 1; j < n; ++j) {
      if (u(random) < 0.1) continue;
      diagonal[j - 1] += w[j - 1] * w[j - 1];
      diagonal[j] += w[j] * w[j];
      off[j] = -w[j] * w[j - 1];
    }
    // Dear enough on the whole that no stretch is worth going on with for ever.
    for (Index j = 0; j < n; ++j) c[j] = std::sin(0.7 * static_cast<double>(j)) + 0.3 * u(random) + 0.2;
    for (Index begin = 0, end = 0; begin < n; begin = end) {
      double sum = 0.0;
      do sum += c[end] / w[end];
      while (++end < n && off[end] < 0.0);
      if (sum < 0.1) c[begin] += (0.1 - sum) * w[begin];
    }
    if (upper) {
      room.resize(n);
      for (Index j = 0; j < n; ++j) room[j] = 1.5 * u(random);
    }
  }

  BoundedChain chain() const { return {diagonal, off, room}; }
  double room_at(Index j) const { return room.size() == 0 ? kUnbounded : room[j]; }

  /// One variable after the other set to its best, until nothing moves: slow, and no code of the active sets.
  Vector by_coordinates() const {
    const Index n = c.size();
    Vector s = Vector::Zero(n);
    for (int sweep = 0; sweep < 200000; ++sweep) {
      double moved = 0.0;
      for (Index j = 0; j < n; ++j) {
        double slope = c[j];
        if (j > 0) slope += off[j] * s[j - 1];
        if (j + 1 < n) slope += off[j + 1] * s[j + 1];
        const double best =
            diagonal[j] > 0.0 ? -slope / diagonal[j] : (slope < 0.0 && room.size() != 0 ? kUnbounded : 0.0);
        const double next = std::clamp(best, 0.0, room_at(j));
        moved = std::max(moved, std::abs(next - s[j]));
        s[j] = next;
      }
      if (moved < 1e-14) break;
    }
    return s;
  }

  /// The conditions of the minimum, which need no oracle.
  void expect_minimum(const BoundedChain& chain, const Vector& s, double tolerance) const {
    Vector multipliers;
    chain.multipliers(c, s, multipliers);
    for (Index j = 0; j < s.size(); ++j) {
      EXPECT_GE(s[j], 0.0);
      EXPECT_LE(s[j], room_at(j));
      EXPECT_TRUE(s[j] <= 0.0 || multipliers[j] <= tolerance) << j;
      EXPECT_TRUE(s[j] >= room_at(j) || multipliers[j] >= -tolerance) << j;
    }
  }
};

TEST(BoundedChain, FindsTheMinimumThatCoordinateDescentFinds) {
  for (const bool upper : {false, true}) {
    for (const double square : {0.0, 0.3}) {
      for (unsigned seed = 0; seed < 12; ++seed) {
        const RandomChain random(40, upper, square, seed);
        const Vector oracle = random.by_coordinates();
        BoundedChain chain = random.chain();
        Vector s;
        chain.minimise(random.c, s);
        EXPECT_NEAR(chain.value(random.c, s), chain.value(random.c, oracle), 1e-9) << upper << square << seed;
        EXPECT_GT(s.maxCoeff(), 0.0);
        random.expect_minimum(chain, s, 1e-9);
      }
    }
  }
}

TEST(BoundedChain, LeavesTheEndsOfLongStretchesFewRoundsFromTheirPlaces) {
  // Humps of the price, thousands of variables long, with noise: from any other start their ends move by one a round.
  constexpr Index n = 40001;
  for (const bool upper : {false, true}) {
    RandomChain random(n, false, 1e-9, 3);
    for (Index j = 0; j < n; ++j) {
      const double x = static_cast<double>(j);
      random.off[j] = j == 0 || j == 17000 ? 0.0 : -1.0;
      random.c[j] = 1e-4 * (0.2 + std::sin(1.3e-3 * x) + 0.5 * std::sin(2e-2 * x + 1.0) + 0.3 * random.c[j]);
    }
    for (Index j = 0; j < n; ++j) random.diagonal[j] = 1e-9 - random.off[j] - (j + 1 < n ? random.off[j + 1] : 0.0);
    if (upper) random.room = Vector::Constant(n, 20.0);
    BoundedChain chain = random.chain();
    Vector s;
    chain.minimise(random.c, s);
    const Index at_zero = (s.array() <= 0.0).count();
    EXPECT_GT(at_zero, n / 10);
    EXPECT_LT(at_zero, 9 * n / 10);
    random.expect_minimum(chain, s, 1e-10);
    EXPECT_LT(chain.sweeps(), 10.0) << upper;
  }
}

TEST(BoundedChain, PutsAVariableThatNothingTiesDownWhereItsCostPushesIt) {
  BoundedChain chain(Vector::Zero(3), Vector::Zero(3), Vector::Constant(3, 2.0));
  const Vector c = Vector{{1.0, -1.0, 0.5}};
  Vector s;
  chain.minimise(c, s);
  EXPECT_EQ(s, (Vector{{0.0, 2.0, 0.0}}));
}

TEST(BoundedChain, ShowsByItsMultipliersThatThereIsNoMinimum) {
  // (s_1 - s_0)^2 / 2 - s_0: falls for ever along s_0 = s_1.
  BoundedChain chain(Vector::Ones(2), Vector{{0.0, -1.0}}, {});
  const Vector c = Vector{{-1.0, 0.0}};
  Vector s, multipliers;
  chain.minimise(c, s);
  chain.multipliers(c, s, multipliers);
  EXPECT_LT(multipliers.minCoeff(), -0.1);
}

TEST(BoundedChain, OfManyVariablesShowsItToo) {
  // Springs alone, and every cost below 0: the start from coarser chains is beyond all numbers.
  constexpr Index n = 20000;
  Vector diagonal = Vector::Constant(n, 2e-300), off = Vector::Constant(n, -1e-300);
  diagonal[0] = diagonal[n - 1] = 1e-300;
  off[0] = 0.0;
  BoundedChain chain(diagonal, off, {});
  const Vector c = Vector::Constant(n, -1e100);
  Vector s, multipliers;
  chain.minimise(c, s);
  chain.multipliers(c, s, multipliers);
  EXPECT_FALSE(multipliers.minCoeff() >= -1e90);
}

TEST(BoundedChain, RefusesWhatIsNoSuchChain) {
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Zero(3), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Ones(2), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(-Vector::Ones(2), Vector::Zero(2), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Zero(2), -Vector::Ones(2)), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
