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
};

TEST(BoundedChain, FindsTheMinimumThatCoordinateDescentFinds) {
  for (const bool upper : {false, true}) {
    for (const double square : {0.0, 0.3}) {
      for (unsigned seed = 0; seed < 12; ++seed) {
        const RandomChain random(40, upper, square, seed);
        const Vector oracle = random.by_coordinates();
        BoundedChain chain = random.chain();
        for (const double start : {0.0, 1.0}) {
          Vector s = Vector::Constant(40, start);
          chain.minimise(random.c, s);
          EXPECT_NEAR(chain.value(random.c, s), chain.value(random.c, oracle), 1e-9) << upper << square << seed;
          EXPECT_GE(s.minCoeff(), 0.0);
          EXPECT_GT(s.maxCoeff(), 0.0);
          Vector multipliers;
          chain.multipliers(random.c, s, multipliers);
          for (Index j = 0; j < 40; ++j) {
            EXPECT_LE(s[j], random.room_at(j));
            EXPECT_TRUE(s[j] <= 0.0 || multipliers[j] <= 1e-9) << j;
            EXPECT_TRUE(s[j] >= random.room_at(j) || multipliers[j] >= -1e-9) << j;
          }
        }
      }
    }
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

TEST(BoundedChain, RefusesWhatIsNoSuchChain) {
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Zero(3), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Ones(2), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(-Vector::Ones(2), Vector::Zero(2), {}), std::invalid_argument);
  EXPECT_THROW(BoundedChain(Vector::Ones(2), Vector::Zero(2), -Vector::Ones(2)), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
