#include "paths/metrics/path_metrics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/poll.h"

namespace dwell {
namespace {

constexpr double kRightAngle = 90.0 * (1.0 + 1e-9);  // so that rounding does not turn a square corner into a reversal
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Turns and directions of the moves, one after the other.
class Course {
 public:
  explicit Course(PathMetrics& metrics) : metrics_(metrics) {}

  void lift() { before_ = {}; }

  void move(Point step) {
    const double along = length(step);
    if (!(along > 0.0)) return;
    if (before_ != Point{}) turn(before_, step);
    before_ = step;
    total_ += along;
    const double phi = std::atan2(step.y, step.x);
    second_ += std::polar(along, 2.0 * phi);
    fourth_ += std::polar(along, 4.0 * phi);
    const double bin = std::floor(phi * kDegrees / 5.0 + 0.5) + kDirectionBins;  // phi > -180: not negative
    metrics_.directions[static_cast<std::size_t>(bin) % kDirectionBins] += along;
  }

  void finish() {
    if (!(total_ > 0.0)) return;
    for (double& share : metrics_.directions) share /= total_;
    metrics_.anisotropy = std::abs(second_) / total_;
    metrics_.lattice_anisotropy = std::abs(fourth_) / total_;
  }

 private:
  void turn(Point a, Point b) {
    const double angle = kDegrees * std::atan2(std::abs(a.x * b.y - a.y * b.x), a.x * b.x + a.y * b.y);
    metrics_.sharpest_corner = std::max(metrics_.sharpest_corner, angle);
    if (angle > kRightAngle) ++metrics_.reversals;
  }

  PathMetrics& metrics_;
  Point before_;  // the last move of this piece; no move has no length
  double total_ = 0.0;
  std::complex<double> second_, fourth_;
};

}  // namespace

PathMetrics path_metrics(const ToolPath& path, const Progress& progress) {
  validate(path);
  progress.check();
  PathMetrics metrics;
  metrics.points = static_cast<Index>(path.size());
  Poll poll(progress);
  for (const Stroke& stroke : moving_strokes(path)) {
    poll.step();
    metrics.length += stroke.length();
  }
  Course course(metrics);
  for (std::size_t j = 1; j < path.size(); ++j) {
    poll.step();
    const Point step = path.points[j] - path.points[j - 1];
    const double move = length(step);
    metrics.point_length += move;
    metrics.longest_jump = std::max(metrics.longest_jump, move);
    if (path.lifted[j]) {
      metrics.lifted_length += move;
      ++metrics.lifts;
      course.lift();
    } else {
      course.move(step);
    }
  }
  course.finish();
  return metrics;
}

}  // namespace dwell
