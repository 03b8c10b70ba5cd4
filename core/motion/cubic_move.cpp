#include "core/motion/cubic_move.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

double largest(double at_start, double at_end, double between) {
  return std::max({std::abs(at_start), std::abs(at_end), std::abs(between)});
}

}  // namespace

Point CubicMove::place(double t) const {
  const double s = t / seconds, left = 1.0 - s;
  const double end = s * s * (3.0 - 2.0 * s);
  return start + end * (finish - start) + seconds * s * left * (left * speed_in - s * speed_out);
}

Point CubicMove::speed(double t) const {
  const double s = t / seconds, left = 1.0 - s;
  return (6.0 * s * left / seconds) * (finish - start) + left * (1.0 - 3.0 * s) * speed_in -
         s * (2.0 - 3.0 * s) * speed_out;
}

Point CubicMove::acceleration(double t) const {
  const double s = t / seconds;
  return (6.0 * (1.0 - 2.0 * s) / (seconds * seconds)) * (finish - start) +
         (1.0 / seconds) * ((6.0 * s - 4.0) * speed_in + (6.0 * s - 2.0) * speed_out);
}

Point largest_speed(const CubicMove& move) {
  const Point a0 = move.acceleration(0.0), a1 = move.acceleration(move.seconds);
  // A speed is largest where its acceleration, a line, crosses zero.
  const auto turning = [&move](double first, double last) {
    const double s = first / (first - last);
    return s > 0.0 && s < 1.0 ? s * move.seconds : 0.0;
  };
  return {largest(move.speed_in.x, move.speed_out.x, move.speed(turning(a0.x, a1.x)).x),
          largest(move.speed_in.y, move.speed_out.y, move.speed(turning(a0.y, a1.y)).y)};
}

Point largest_acceleration(const CubicMove& move) {
  const Point a0 = move.acceleration(0.0), a1 = move.acceleration(move.seconds);
  return {largest(a0.x, a1.x, 0.0), largest(a0.y, a1.y, 0.0)};
}

std::vector<Point> places_on(const CubicMove& move, double parts_from_rest) {
  const Point fastest = largest_speed(move), a0 = move.acceleration(0.0), a1 = move.acceleration(move.seconds);
  const double change = 0.5 * move.seconds * (length(a0) + length(a1));
  const double most = std::max(length(fastest), 1e-300);
  const auto parts = static_cast<int>(std::max(1.0, std::ceil(parts_from_rest * std::min(4.0, change / most))));
  std::vector<Point> places{move.start};
  for (int k = 1; k < parts; ++k) places.push_back(move.place(move.seconds * k / parts));
  places.push_back(move.finish);
  return places;
}

}  // namespace dwell
