#include "paths/feed/trapezoid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dwell {
namespace {

/// By small steps of time: accelerates as long as the way left allows to slow down.
double stepped_time(const Trapezoid& m, double feed, double step) {
  double s = 0.0, v = m.speed_in, t = 0.0;
  while (s < m.length && t < 1e3) {
    const double brake = (v * v - m.speed_out * m.speed_out) / (2.0 * m.acceleration);
    if (m.length - s <= brake) {
      v = std::max(m.speed_out, v - m.acceleration * step);
    } else {
      v = std::min(feed, v + m.acceleration * step);
    }
    s += v * step;
    t += step;
  }
  return t;
}

TEST(Trapezoid, TakesTheTimeOfAMotionByStepsOfTime) {
  for (const Trapezoid& m :
       {Trapezoid{2.0, 30.0, 0.0, 0.0}, Trapezoid{2.0, 30.0, 3.0, 1.0}, Trapezoid{0.5, 10.0, 1.0, 2.0}}) {
    for (const double feed : {3.2, 5.0, 50.0})
      EXPECT_NEAR(time_at_feed(m, feed), stepped_time(m, feed, 1e-5), 2e-3) << m.speed_in << ' ' << feed;
  }
  EXPECT_DOUBLE_EQ(time_at_feed({4.0, 2.0, 0.0, 0.0}, 100.0), 2.0 * std::sqrt(2.0));  // up and down again
  EXPECT_TRUE(std::isinf(time_at_feed({1.0, 2.0, 0.0, 0.0}, 0.0)));
  EXPECT_DOUBLE_EQ(time_at_feed({3.0, INFINITY, 0.0, 0.0}, 6.0), 0.5);
}

TEST(Trapezoid, FindsTheFeedThatTakesATime) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int held = 0;
  for (int k = 0; k < 300; ++k) {
    std::vector<Trapezoid> moves;
    double corner = 2.0 * unit(random);
    for (int i = 0; i < 1 + k % 3; ++i) {
      const double length = 0.2 + unit(random), next = std::sqrt(corner * corner + length * (unit(random) - 0.2));
      moves.push_back({length, 8.0, corner, std::isnan(next) ? 0.0 : next});
      if (std::isnan(next)) moves.back().speed_in = 0.0;
      corner = moves.back().speed_out;
    }
    double fastest = 0.0;
    for (const Trapezoid& m : moves) fastest += time_at_feed(m, 100.0);
    const double seconds = fastest * (1.0 + 0.5 * unit(random));
    const double feed = feed_for_time(moves, seconds, 100.0);
    double taken = 0.0, fastest_end = 0.0;
    for (const Trapezoid& m : moves) {
      taken += time_at_feed(m, feed);
      fastest_end = std::max({fastest_end, m.speed_in, m.speed_out});
    }
    if (feed < fastest_end) {
      EXPECT_LT(taken, seconds) << k;
    } else {
      EXPECT_NEAR(taken, seconds, 1e-9 * seconds) << k;
      ++held;
    }
  }
  EXPECT_GT(held, 100);
  EXPECT_EQ(feed_for_time({{1.0, 8.0, 0.0, 0.0}}, 1e-3, 40.0), 40.0);  // cannot
}

TEST(Trapezoid, IsMadeOfPiecesThatAddUp) {
  for (const double feed : {0.5, 2.0, 4.0, 9.0, 90.0}) {
    const Trapezoid m{1.7, 12.0, 1.5, 3.0};
    double length = 0.0, seconds = 0.0, speed = m.speed_in;
    for (const MotionPiece& piece : pieces_at_feed(m, feed)) {
      EXPECT_EQ(piece.speed_in, speed);
      EXPECT_NEAR(std::abs(piece.speed_out * piece.speed_out - speed * speed),
                  piece.speed_out == speed ? 0.0 : 2.0 * 12.0 * piece.length, 1e-12);
      speed = piece.speed_out;
      length += piece.length;
      seconds += piece.seconds();
    }
    EXPECT_EQ(speed, m.speed_out);
    EXPECT_NEAR(length, m.length, 1e-14);
    EXPECT_NEAR(seconds, time_at_feed(m, feed), 1e-14);
  }
}

}  // namespace
}  // namespace dwell
