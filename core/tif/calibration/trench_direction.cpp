#include "core/tif/calibration/trench_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/rotation.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

constexpr double kDeepShare = 0.3;  // of the deepest
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// What is deep, by its second moments.
struct DeepRegion {
  Point middle;
  double angle = 0.0;                // of its longer axis [deg]
  double longer = 0.0, wider = 0.0;  // roots of its second moments [mm]
};

/// The depth that one pixel in 200 exceeds: unlike the deepest pixel, no outlier.
double deepest_of(const HeightMap& depth) {
  constexpr std::size_t kOneIn = 200;
  std::vector<double> values;
  for (const double v : depth.values) {
    if (std::isfinite(v)) values.push_back(v);
  }
  if (values.empty()) return 0.0;
  const auto at = values.end() - 1 - static_cast<std::ptrdiff_t>(values.size() / kOneIn);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

DeepRegion deep_region(const HeightMap& depth, double level) {
  DeepRegion region;
  double sum = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Point moment;
  const auto each = [&](auto&& visit) {
    for (Index i = 0; i < depth.grid.size(); ++i) {
      const double v = depth.values[static_cast<std::size_t>(i)];
      if (v > level) visit(depth.grid.centre(i), v);
    }
  };
  each([&](Point p, double v) { sum += v, moment = moment + v * p; });
  region.middle = (1.0 / sum) * moment;
  each([&](Point p, double v) {
    const Point d = p - region.middle;
    xx += v * d.x * d.x / sum, xy += v * d.x * d.y / sum, yy += v * d.y * d.y / sum;
  });
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  region.longer = std::sqrt(mean + half), region.wider = std::sqrt(std::max(0.0, mean - half));
  region.angle = 0.5 * std::atan2(2.0 * xy, xx - yy) * kDegrees;
  return region;
}

/// A stretch of the track and the centroid of its depth across.
struct Stretch {
  double along = 0.0, across = 0.0, volume = 0.0;
};

/// The sums of one stretch.
struct StretchSums {
  double depth = 0.0, moment = 0.0, along = 0.0;
  Index pixels = 0;
};

/// The whole stretches along `angle` about `middle`, within `reach` across.
std::vector<Stretch> stretches(const HeightMap& depth, double angle, Point middle, double reach) {
  const Rotation turn(angle);
  const Grid& g = depth.grid;
  const double step = std::max(0.5 * reach, 3.0 * std::max(g.pitch_x, g.pitch_y));
  const double far = std::hypot(g.width(), g.height());
  std::vector<StretchSums> sums(2 * static_cast<std::size_t>(std::ceil(far / step)) + 2);
  for (Index i = 0; i < g.size(); ++i) {
    const double v = depth.values[static_cast<std::size_t>(i)];
    const Point q = turn.back(g.centre(i) - middle);
    const double place = std::floor((q.x + far) / step);
    if (!std::isfinite(v) || std::abs(q.y) > reach || place < 0.0 || place >= static_cast<double>(sums.size()))
      continue;
    StretchSums& s = sums[static_cast<std::size_t>(place)];
    s.depth += v, s.moment += v * q.y, s.along += q.x, ++s.pixels;
  }
  constexpr double kWhole = 0.93;  // a lattice of pixels does not fill a stretch evenly
  std::vector<Stretch> result;
  std::vector<double> volumes;
  for (const StretchSums& s : sums) {
    const double area = static_cast<double>(s.pixels) * g.pitch_x * g.pitch_y;
    if (!(area >= kWhole * 2.0 * reach * step && s.depth > 0.0)) continue;
    result.push_back({s.along / static_cast<double>(s.pixels), s.moment / s.depth, s.depth});
    volumes.push_back(s.depth);
  }
  if (result.empty()) return result;
  const double usual = upper_median(volumes);
  std::erase_if(result, [usual](const Stretch& s) { return s.volume < 0.5 * usual; });
  return result;
}

/// A straight line through the centroids: its slope with its standard error, and its height at 0.
struct CentroidLine {
  double slope = 0.0, error = 0.0, offset = 0.0;
};

CentroidLine line_through(const std::vector<Stretch>& parts) {
  const double n = static_cast<double>(parts.size());
  double u = 0.0, v = 0.0, uu = 0.0, uv = 0.0, square = 0.0;
  for (const Stretch& s : parts) u += s.along / n, v += s.across / n;
  for (const Stretch& s : parts) uu += (s.along - u) * (s.along - u), uv += (s.along - u) * (s.across - v);
  CentroidLine line;
  line.slope = uv / uu;
  line.offset = v - line.slope * u;
  for (const Stretch& s : parts) square += std::pow(s.across - line.offset - line.slope * s.along, 2);
  line.error = std::sqrt(square / (n - 2.0) / uu);
  return line;
}

/// In -90 (not itself) .. 90.
double as_track(double degrees) { return degrees - 180.0 * std::ceil((degrees - 90.0) / 180.0); }

}  // namespace

double angle_between_tracks(double a, double b) { return std::abs(as_track(a - b)); }

double direction_tolerance(const TrenchDirection& fitted) {
  constexpr double kErrors = 5.0, kMost = 1.0, kShareOfWidth = 0.05;
  const double by_width = std::atan2(2.0 * kShareOfWidth * fitted.width, fitted.length) * kDegrees;
  return std::max(kErrors * fitted.standard_error, std::min(kMost, by_width));
}

std::optional<TrenchDirection> fit_trench_direction(const HeightMap& depth) {
  constexpr double kElongation = 1.5;
  constexpr double kReachInWidths = 3.5;  // of the root of the second moment across
  constexpr std::size_t kFewest = 4;
  constexpr int kTurns = 5;
  const double deepest = deepest_of(depth);
  if (!(deepest > 0.0)) return std::nullopt;
  const DeepRegion region = deep_region(depth, kDeepShare * deepest);
  if (!(region.longer > kElongation * region.wider)) return std::nullopt;
  const double reach = std::max(kReachInWidths * region.wider, 3.0 * std::max(depth.grid.pitch_x, depth.grid.pitch_y));
  TrenchDirection fitted{region.angle, 0.0, std::sqrt(12.0) * region.wider, 0.0};
  Point middle = region.middle;
  for (int turn = 0; turn < kTurns; ++turn) {
    const std::vector<Stretch> parts = stretches(depth, fitted.degrees, middle, reach);
    if (parts.size() < kFewest) return std::nullopt;
    const CentroidLine line = line_through(parts);
    middle = middle + Rotation(fitted.degrees)({0.0, line.offset});
    fitted.degrees = as_track(fitted.degrees + std::atan(line.slope) * kDegrees);
    fitted.standard_error = line.error * kDegrees;
    fitted.length = parts.back().along - parts.front().along;
    if (std::abs(line.slope) < 0.01 * line.error) break;
  }
  return fitted;
}

}  // namespace dwell
