#include "paths/feed/trapezoid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

// Of a move's length, what is left between accelerating and slowing down is rounding: such a piece would have no
// direction.
constexpr double kLengthRounding = 1e-12;

double squared(double v) { return v * v; }

double held(const Trapezoid& move, double feed) {
  return std::max({move.speed_in, move.speed_out, std::min({feed, move.most, peak_speed(move)})});
}

/// The argument between two at which a falling function has a value, to the last digits; the bounds must hold it.
/// Regula falsi with the Illinois rule.
template <class Function>
double find_falling(double low, double high, double value, const Function& function) {
  double over = function(low) - value, under = function(high) - value;
  if (!(over > 0.0)) return low;
  if (!(under < 0.0)) return high;
  int side = 0;
  for (int step = 0; step < 100 && high - low > 4e-16 * high; ++step) {
    double middle = (low * under - high * over) / (under - over);
    if (!(middle > low && middle < high) || step % 3 == 2) middle = 0.5 * (low + high);
    const double there = function(middle) - value;
    if (there > 0.0) {
      low = middle, over = there;
      if (side > 0) under *= 0.5;
      side = 1;
    } else {
      high = middle, under = there;
      if (there == 0.0) return middle;
      if (side < 0) over *= 0.5;
      side = -1;
    }
  }
  return high;
}

/// The same as extended_time for changes of speed by S: each takes t over (in + v) / 2 t, which leaves L / v + t |v -
/// in| / 2 v for both ends together. It falls with v.
double extended_time_of_s(const Trapezoid& m, double feed) {
  const double v = std::min({feed, m.most, peak_speed(m)});
  double sum = m.length;
  for (const double end : {m.speed_in, m.speed_out}) sum += 0.5 * m.change().seconds(v - end) * std::abs(v - end);
  return sum / v;
}

/// The time of a move at a feed v, T = (2 v - in - out) / a + (L - (2 v^2 - in^2 - out^2) / 2 a) / v, with the same
/// formula for feeds below the ends' speeds: it grows without end as the feed goes to 0, so that every time has a feed,
/// and the speeds at the ends, which follow from the feeds, are too high only until the next round.
double extended_time(const Trapezoid& m, double feed) {
  if (m.change().limits_jerk()) return extended_time_of_s(m, feed);
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

/// feed_for_time with a limit of jerk.
double feed_for_time_by_s(const std::vector<Trapezoid>& moves, double seconds, double most) {
  if (!(time_of_all(moves, most) < seconds)) return most;
  double length = 0.0;
  for (const Trapezoid& m : moves) length += m.length;
  return find_falling(std::min(most, length / seconds), most, seconds,
                      [&](double feed) { return time_of_all(moves, feed); });
}

/// A change of speed by a machine that limits jerk, as two or three pieces that come to so much of their way: what is
/// more is rounding.
void add_s(std::vector<MotionPiece>& pieces, const SpeedChange& change, double from, double to, double scale) {
  const double seconds = change.seconds(to - from), peak = change.peak(to - from);
  const double bent = std::min(0.5 * seconds, peak / change.jerk), even = seconds - 2.0 * bent;
  const double sign = to > from ? 1.0 : -1.0, first = from + sign * 0.5 * peak * bent;
  const double second = to - sign * 0.5 * peak * bent;
  const auto way = [&](double begin, double end, double bend) {
    return scale * (0.5 * (begin + end) * bent - bend * bent * bent * bent / 12.0);
  };
  const double jerk = sign * change.jerk;
  pieces.push_back({way(from, first, jerk), from, first, jerk, bent});
  if (even > 1e-12 * seconds) pieces.push_back({scale * 0.5 * (first + second) * even, first, second});
  pieces.push_back({way(second, to, -jerk), second, to, -jerk, bent});
}

}  // namespace

double MotionPiece::seconds() const {
  if (jerk != 0.0) return jerk_seconds;
  return length > 0.0 ? 2.0 * length / (speed_in + speed_out) : 0.0;
}

double MotionPiece::acceleration_in() const {
  const double all = seconds();
  return all > 0.0 ? (speed_out - speed_in) / all - 0.5 * jerk * all : 0.0;
}

double MotionPiece::way(double t) const { return t * (speed_in + t * (0.5 * acceleration_in() + t * jerk / 6.0)); }

double MotionPiece::speed(double t) const { return speed_in + t * (acceleration_in() + 0.5 * t * jerk); }

double peak_speed(const Trapezoid& move) {
  double peak = std::sqrt(move.acceleration * move.length + 0.5 * (squared(move.speed_in) + squared(move.speed_out)));
  const double least = std::max(move.speed_in, move.speed_out);
  if (const SpeedChange change = move.change(); change.limits_jerk()) {
    const double fastest = std::min(peak, change.reached(std::min(move.speed_in, move.speed_out), move.length));
    peak = find_falling(least, fastest, -move.length,
                        [&](double v) { return -change.length(move.speed_in, v) - change.length(move.speed_out, v); });
  }
  return std::max(peak, least);  // rounding
}

double time_at_feed(const Trapezoid& move, double feed) {
  const double v = held(move, feed);
  if (!(v > 0.0)) return std::numeric_limits<double>::infinity();
  if (const SpeedChange change = move.change(); change.limits_jerk()) {
    const double up = change.seconds(v - move.speed_in), down = change.seconds(v - move.speed_out);
    const double ways = 0.5 * (up * (v + move.speed_in) + down * (v + move.speed_out));
    return up + down + std::max(0.0, move.length - ways) / v;
  }
  const double ramps =
      (2.0 * squared(v) - squared(move.speed_in) - squared(move.speed_out)) / (2.0 * move.acceleration);
  return (2.0 * v - move.speed_in - move.speed_out) / move.acceleration + std::max(0.0, move.length - ramps) / v;
}

double feed_for_time(const std::vector<Trapezoid>& moves, double seconds, double most) {
  if (!moves.empty() && moves.front().change().limits_jerk()) return feed_for_time_by_s(moves, seconds, most);
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

namespace {

std::vector<MotionPiece> pieces_by_s(const Trapezoid& move, double v) {
  const SpeedChange change = move.change();
  const double up = change.length(move.speed_in, v), down = change.length(move.speed_out, v);
  const double scale = std::min(1.0, move.length / std::max(up + down, 1e-300));  // rounding at the peak
  std::vector<MotionPiece> pieces;
  if (v > move.speed_in) add_s(pieces, change, move.speed_in, v, scale);
  const double even = move.length - scale * (up + down);
  if (even > kLengthRounding * move.length) pieces.push_back({even, v, v});
  if (v > move.speed_out) add_s(pieces, change, v, move.speed_out, scale);
  return pieces;
}

}  // namespace

std::vector<MotionPiece> pieces_at_feed(const Trapezoid& move, double feed) {
  const double v = held(move, feed);
  if (move.change().limits_jerk()) return pieces_by_s(move, v);
  const double up = (squared(v) - squared(move.speed_in)) / (2.0 * move.acceleration);
  const double down = (squared(v) - squared(move.speed_out)) / (2.0 * move.acceleration);
  const double scale = std::min(1.0, move.length / std::max(up + down, 1e-300));  // rounding at the peak
  std::vector<MotionPiece> pieces;
  const auto add = [&](double length, double in, double out) {
    if (length > kLengthRounding * move.length && in + out > 0.0) pieces.push_back({length, in, out});
  };
  add(scale * up, move.speed_in, v);
  add(move.length - scale * (up + down), v, v);
  add(scale * down, v, move.speed_out);
  return pieces;
}

}  // namespace dwell
