#include "solvers/weights/monotone_root.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

struct Point {
  double x = 0.0, f = 0.0;
};

class RootSearch {
 public:
  explicit RootSearch(const MonotoneRoot& problem) : p_(problem) {}

  RootEnd run() {
    const std::optional<RootEnd> end = bracket();
    return end ? *end : narrow();
  }

 private:
  /// Nothing once the root lies between low_ and high_.
  std::optional<RootEnd> bracket() {
    constexpr double kMostBeyond = 5.0, kLeastFirst = 0.1;
    double x = std::clamp(p_.start, 0.0, p_.ceiling), step = p_.first_step;
    while (true) {
      const std::optional<double> f = p_.value(x);
      if (!f) return RootEnd::Stopped;
      if (*f == 0.0) return RootEnd::Found;
      const bool is_low = *f < 0.0;
      std::optional<Point>& side = is_low ? low_ : high_;
      const std::optional<Point> before = side;
      side = Point{x, *f};
      if (low_ && high_) return std::nullopt;
      if (before) {
        step = next_step(*before, *side, step);
      } else if (p_.usual_slope > 0.0) {
        step = std::clamp(std::abs(*f) / p_.usual_slope, kLeastFirst, kMostBeyond);
      }
      if (is_low) {
        const bool risen_no_more = before && x > p_.ordinary_end && *f - before->f < p_.flat * (x - before->x);
        if (x >= p_.ceiling || risen_no_more) return RootEnd::AtMost;
        if (x >= p_.ordinary_end) step = std::min(step, kMostBeyond);
        x = std::min(x + step, x < p_.ordinary_end ? p_.ordinary_end : p_.ceiling);
      } else {
        if (x <= 0.0) return RootEnd::AtZero;
        x = std::max(x - step, 0.0);
      }
    }
  }

  /// Somewhat farther than where the secant crosses zero, within limits.
  static double next_step(const Point& before, const Point& now, double step) {
    constexpr double kBeyond = 1.1, kLeastGrowth = 0.25, kMostGrowth = 3.0, kUsualGrowth = 2.0;
    const double slope = (now.f - before.f) / (now.x - before.x);
    const double wanted = slope > 0.0 ? kBeyond * std::abs(now.f) / slope : kUsualGrowth * step;
    return std::clamp(wanted, kLeastGrowth * step, kMostGrowth * step);
  }

  RootEnd narrow() {
    Point low = *low_, high = *high_;
    double width = high.x - low.x, width_before = 2.0 * width, width_two_before = 2.0 * width;
    int kept = 0;  // how often in a row the low (< 0) or the high end was kept
    for (; width > p_.narrow; width = high.x - low.x) {
      const bool creeps = width > 0.5 * width_two_before;
      width_two_before = width_before;
      width_before = width;
      const double x = creeps ? 0.5 * (low.x + high.x) : between(low, high);
      const std::optional<double> f = p_.value(x);
      if (!f) return RootEnd::Stopped;
      if (*f == 0.0) return RootEnd::Found;
      if (*f < 0.0) {
        low = {x, *f};
        kept = std::max(kept, 0) + 1;
        if (kept > 1) high.f *= 0.5;
      } else {
        high = {x, *f};
        kept = std::min(kept, 0) - 1;
        if (kept < -1) low.f *= 0.5;
      }
    }
    return RootEnd::Found;
  }

  static double between(const Point& low, const Point& high) {
    constexpr double kMargin = 0.02;  // of the bracket, on either side
    const double share = std::clamp(low.f / (low.f - high.f), kMargin, 1.0 - kMargin);
    return low.x + share * (high.x - low.x);
  }

  const MonotoneRoot& p_;
  std::optional<Point> low_, high_;
};

}  // namespace

RootEnd find_monotone_root(const MonotoneRoot& problem) { return RootSearch(problem).run(); }

}  // namespace dwell
