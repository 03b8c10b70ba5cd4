#include "paths/curves/spiral.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/poll.h"

namespace dwell {
namespace {

/// Arc length of rho = theta from 0 to theta.
double arc_length(double theta, double slope) { return 0.5 * (theta * slope + std::log(theta + slope)); }

/// Angle theta at which the spiral rho = theta has an arc length s.
class AngleOfArc {
 public:
  /// At arc lengths first + k * step.
  AngleOfArc(double first, double step) : first_(first), step_(step), theta_(std::sqrt(2.0 * first)) { solve(first); }

  /// Angle at arc length first + k * step. Calls with k one more than before are cheap; any k is right.
  double operator()(double k) {
    const double ahead = (k - k_) * step_;
    k_ = k;
    const double arc = first_ + k * step_;
    const double w2 = 1.0 + theta_ * theta_;
    const double w = std::sqrt(w2);
    const double u = ahead / w2;
    if (u > 0.5) {  // a long leap, or near the centre: s is about theta^2 / 2
      theta_ = std::sqrt(2.0 * arc);
      solve(arc);
      return theta_;
    }
    // Taylor series of theta(s), of derivatives 1/w, -theta/w^4, (3 theta^2 - 1)/w^7, theta (13 - 15 theta^2)/w^10. The
    // term after them is less than (u w)^5 / theta^4: far out it is nothing beside rounding, and Newton's method is
    // needed only to keep it from adding up.
    const double t2 = theta_ * theta_;
    const bool exact = theta_ > kFarOut && u * w < kSmallTurn && ++taken_ < kMostTaken;
    theta_ +=
        u *
        (w - u * (0.5 * theta_ - u * ((3.0 * t2 - 1.0) / (6.0 * w) + u * theta_ * (13.0 - 15.0 * t2) / (24.0 * w2))));
    if (!exact) solve(arc);
    return theta_;
  }

 private:
  void solve(double arc) {
    // s(theta) is convex: Newton's steps converge from anywhere. The last one leaves less than its square.
    double correction = 1.0;
    for (int i = 0; i < kMostSteps && std::abs(correction) > kLastStep; ++i) {
      const double slope = std::sqrt(1.0 + theta_ * theta_);
      correction = (arc_length(theta_, slope) - arc) / slope;
      theta_ = std::max(theta_ - correction, 0.0);
    }
    taken_ = 0;
  }

  static constexpr int kMostSteps = 50;
  static constexpr double kLastStep = 1e-8;
  static constexpr double kFarOut = 200.0;
  static constexpr double kSmallTurn = 0.05;  // the term left out is less than 2e-16
  static constexpr int kMostTaken = 32;
  double first_, step_;
  double theta_;
  double k_ = 0.0;
  int taken_ = 0;  // terms of the series taken since the last solution
};

/// (cos, sin) of an angle that grows by little from call to call. The previous result is rotated by the series to the
/// seventh power, and computed anew before rounding adds up.
class TurningUnit {
 public:
  Point operator()(double angle) {
    const double turn = angle - angle_;
    angle_ = angle;
    if (std::abs(turn) > kLargestTurn || ++turns_ > kMostTurns) {
      turns_ = 0;
      return unit_ = {std::cos(angle), std::sin(angle)};
    }
    const double t2 = turn * turn;
    const double cosine = 1.0 - t2 * (1.0 / 2.0 - t2 * (1.0 / 24.0 - t2 / 720.0));
    const double sine = turn * (1.0 - t2 * (1.0 / 6.0 - t2 * (1.0 / 120.0 - t2 / 5040.0)));
    return unit_ = {unit_.x * cosine - unit_.y * sine, unit_.y * cosine + unit_.x * sine};
  }

 private:
  static constexpr double kLargestTurn = 0.05;  // the first term left out is 1e-15
  static constexpr int kMostTurns = 32;
  double angle_ = 0.0;
  Point unit_{1.0, 0.0};
  int turns_ = 0;
};

}  // namespace

SpiralOptions parse_spiral_options(const SpecText& spec) { return {parse_centred_curve(spec)}; }

std::vector<PathDistance> spiral_distances(const SpiralOptions& options) {
  return {{"pitch", options.pitch}, {"step", options.step.value_or(0.0)}};
}

ToolPath spiral_path(const HeightMap& map, const SpiralOptions& options, const Progress& progress) {
  const CentredDomain part(map, options, 1.0, "spiral", progress);
  const double scale = part.pitch / (2.0 * std::numbers::pi);  // rho = scale * theta
  const auto steps_to = [&](double radius) {
    const double theta = radius / scale;
    return scale * arc_length(theta, std::sqrt(1.0 + theta * theta)) / part.step;
  };
  const double first = std::floor(steps_to(part.radius.low));
  const double last = std::floor(steps_to(part.radius.high));
  part.check_size(last - first + 1.0, "spiral");

  ToolPath path;
  path.kind = "spiral";
  path.points.reserve(part.about_points(last - first + 1.0));
  path.lifted.reserve(path.points.capacity());
  const double side = options.clockwise ? -1.0 : 1.0;
  AngleOfArc angle(first * part.step / scale, part.step / scale);
  TurningUnit unit;
  bool outside = true;
  double sure = 0.0;  // so many of the following points are known to be inside
  std::size_t pieces = 0;
  Poll poll(progress);
  for (double k = 0.0; k <= last - first; ++k) {
    poll.step();
    const double theta = angle(k);
    const double rho = scale * theta;
    const Point out = unit(theta);
    const Point p{part.centre.x + rho * out.x, part.centre.y + side * rho * out.y};
    if (--sure < 0.0) {
      const DomainView view = part.domain.look(p);
      sure = std::floor(view.holds_for / part.step * (1.0 - 1e-9));
      if (!view.inside) {
        k += sure;
        sure = 0.0;
        outside = true;
        continue;
      }
    }
    path.points.push_back(p);
    path.lifted.push_back(outside ? 1 : 0);
    pieces += outside ? 1 : 0;
    outside = false;
  }
  if (pieces > 1) {
    path.notes.push_back(fmt::format("the spiral leaves the part {}; it is lifted there", counted(pieces - 1, "time")));
  }
  if (options.from_edge) reverse(path);
  return path;
}

}  // namespace dwell
