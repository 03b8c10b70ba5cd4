#include "paths/feed/trapezoid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

double squared(double v) { return v * v; }

double held(const Trapezoid& move, double feed) {
  return std::max({move.speed_in, move.speed_out, std::min({feed, move.most, peak_speed(move)})});
}

/// The time of a move at a feed v, T = (2 v - in - out) / a + (L - (2 v^2 - in^2 - out^2) / 2 a) / v, with the same
/// formula for feeds below the ends' speeds: it grows without end as the feed goes to 0, so that every time has a feed,
/// and the speeds at the ends, which follow from the feeds, are too high only until the next round.
double extended_time(const Trapezoid& m, double feed) {
  const double v = std::min({feed, m.most, peak_speed(m)});
  const double ramps = (2.0 * squared(v) - squared(m.speed_in) - squared(m.speed_out)) / (2.0 * m.acceleration);
  return (2.0 * v - m.speed_in - m.speed_out) / m.acceleration + (m.length - ramps) / v;
}

double time_of_all(const std::vector<Trapezoid>& moves, double feed) {
  double sum = 0.0;
  for (const Trapezoid& move : moves) sum += extended_time(move, feed);
  return sum;
}

/// d T / d feed: 1 / a - (L + (in^2 + out^2) / 2 a) / v^2, and 0 above the peak and above `most`.
double slope_of_all(const std::vector<Trapezoid>& moves, double feed) {
  double sum = 0.0;
  for (const Trapezoid& m : moves) {
    if (feed >= std::min(m.most, peak_speed(m))) continue;
    const double ends = (squared(m.speed_in) + squared(m.speed_out)) / (2.0 * m.acceleration);
    sum += 1.0 / m.acceleration - (m.length + ends) / squared(feed);
  }
  return sum;
}

/// The feed that takes a time if no move's peak is below it: the lesser root of sum(1/a) F^2 - (sum((in + out) / a) +
/// t) F + sum(L + (in^2 + out^2) / 2 a) = 0. Infinite if there is none.
double feed_below_peaks(const std::vector<Trapezoid>& moves, double seconds) {
  double a = 0.0, b = seconds, c = 0.0, peak = std::numeric_limits<double>::infinity();
  for (const Trapezoid& m : moves) {
    a += 1.0 / m.acceleration;
    b += (m.speed_in + m.speed_out) / m.acceleration;
    c += m.length + (squared(m.speed_in) + squared(m.speed_out)) / (2.0 * m.acceleration);
    peak = std::min({peak, m.most, peak_speed(m)});
  }
  const double discriminant = b * b - 4.0 * a * c;
  const double feed =
      discriminant >= 0.0 ? 2.0 * c / (b + std::sqrt(discriminant)) : std::numeric_limits<double>::infinity();
  return feed <= peak ? feed : std::numeric_limits<double>::infinity();
}

}  // namespace

double peak_speed(const Trapezoid& move) {
  const double peak =
      std::sqrt(move.acceleration * move.length + 0.5 * (squared(move.speed_in) + squared(move.speed_out)));
  return std::max({peak, move.speed_in, move.speed_out});  // rounding
}

double time_at_feed(const Trapezoid& move, double feed) {
  const double v = held(move, feed);
  if (!(v > 0.0)) return std::numeric_limits<double>::infinity();
  const double ramps =
      (2.0 * squared(v) - squared(move.speed_in) - squared(move.speed_out)) / (2.0 * move.acceleration);
  return (2.0 * v - move.speed_in - move.speed_out) / move.acceleration + std::max(0.0, move.length - ramps) / v;
}

double feed_for_time(const std::vector<Trapezoid>& moves, double seconds, double most) {
  const double direct = feed_below_peaks(moves, seconds);
  if (std::isfinite(direct)) return std::min(direct, most);
  if (!(time_of_all(moves, most) < seconds)) return most;
  double length = 0.0;
  for (const Trapezoid& m : moves) length += m.length;
  double low = 0.0, high = most;
  // Time falls with the feed and is convex in it: from below, Newton's steps do not overshoot. Bisection guards against
  // the kinks where a move reaches its peak.
  double feed = std::min(most, length / seconds);
  for (int step = 0; step < 60; ++step) {
    const double excess = time_of_all(moves, feed) - seconds;
    (excess > 0.0 ? low : high) = feed;
    if (std::abs(excess) <= 1e-13 * seconds) break;
    const double slope = slope_of_all(moves, feed), next = feed - excess / slope;
    feed = slope < 0.0 && next > low && next < high ? next : 0.5 * (low + std::min(high, 2.0 * (low + feed)));
    if (!(high - low > 1e-14 * high)) break;
  }
  return feed;
}

std::vector<MotionPiece> pieces_at_feed(const Trapezoid& move, double feed) {
  const double v = held(move, feed);
  const double up = (squared(v) - squared(move.speed_in)) / (2.0 * move.acceleration);
  const double down = (squared(v) - squared(move.speed_out)) / (2.0 * move.acceleration);
  const double scale = std::min(1.0, move.length / std::max(up + down, 1e-300));  // rounding at the peak
  std::vector<MotionPiece> pieces;
  const auto add = [&pieces](double length, double in, double out) {
    if (length > 0.0 && in + out > 0.0) pieces.push_back({length, in, out});
  };
  add(scale * up, move.speed_in, v);
  add(move.length - scale * (up + down), v, v);
  add(scale * down, v, move.speed_out);
  return pieces;
}

}  // namespace dwell
