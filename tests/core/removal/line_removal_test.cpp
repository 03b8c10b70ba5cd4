#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/motion/tool_path.h"
#include "core/removal/scattered_removal.h"
#include "core/removal/sparse_removal.h"

/// The removal of a spinning disc that runs along straight lines at constant speed, known in closed form: Lin et al.
/// 2014, equations 5, 7 (one line) and 8 (lines at an interval).
namespace dwell {
namespace {

constexpr double kLineSlope = 0.8, kLineRadius = 3.0, kLineSpeed = 2.5;

/// Equation 7: slope / speed times the integral of sqrt(x^2 + y^2) along the chord of the disc at y [nm].
double line_profile(double y) {
  const double a = std::abs(y);
  if (a >= kLineRadius) return 0.0;
  const double s = std::sqrt(kLineRadius * kLineRadius - a * a);
  const double inner = a > 0.0 ? a * a * (std::log(kLineRadius + s) - std::log(a)) : 0.0;
  return kLineSlope / kLineSpeed * (kLineRadius * s + inner);
}

/// What the operator computes is the kernel's line integral: on a pixel, the profile's mean over the pixel (the
/// kernel's samples are means over pixels, since the rim is a jump); between pixels, the cubic spline through those. A
/// mean is within half the rise of its pixel, and a spline answers a rise k samples away by 0.27^k of it (its ringing):
/// the profile drops with infinite slope at the rim. The last term is the kernel's sampling of the disc.
double tolerance(double y, double pitch) {
  double sum = 0.0;
  for (int k = -8; k <= 8; ++k) {
    const double rise = line_profile(y + (k + 0.5) * pitch) - line_profile(y + (k - 0.5) * pitch);
    sum += 0.5 * std::pow(0.27, std::abs(k)) * std::abs(rise);
  }
  return sum + 2e-3 * line_profile(0.0);
}

struct Lines {
  Grid map;
  std::vector<Index> pixels;
  ToolPath path;

  /// Lines along x at the given y, long enough for the strip of map in the middle not to see their ends.
  Lines(double pitch, const std::vector<double>& ys) : map{141, 5, pitch, pitch, {-2.0 * pitch, -70.0 * pitch}} {
    for (Index i = 0; i < map.size(); ++i) pixels.push_back(i);
    for (double y : ys) {
      for (int k = 0; k <= 50; ++k) {
        path.points.push_back({0.37 * (k - 25) + 0.11, y});
        path.lifted.push_back(k == 0);
      }
    }
  }

  /// Removal at constant speed: every stroke takes its length over the speed.
  Vector removal(bool sparse) const {
    const RemovalKernel kernel =
        removal_kernel(spinning_disc_removal(kLineSlope, kLineRadius), map.pitch_x, map.pitch_y);
    const auto strokes = moving_strokes(path);
    std::unique_ptr<RemovalOperator> a;
    if (sparse) {
      a = std::make_unique<SparseRemoval>(map, pixels, kernel, strokes, 1);
    } else {
      a = std::make_unique<ScatteredRemoval>(map, pixels, kernel, strokes, 1);
    }
    Vector t(a->cols()), result;
    for (Index j = 0; j < t.size(); ++j) t[j] = strokes[static_cast<std::size_t>(j)].length() / kLineSpeed;
    a->apply(t, result);
    return result;
  }
};

TEST(LineRemoval, IsTheProfileOfTheClosedForm) {
  for (bool sparse : {false, true}) {
    for (double pitch : {0.2, 0.1, 0.06}) {
      for (double offset : {0.0, 0.37}) {
        const double line = offset * pitch;
        const Lines lines(pitch, {line});
        const Vector removal = lines.removal(sparse);
        double worst = 0.0;
        for (Index i = 0; i < lines.map.size(); ++i) {
          const double y = lines.map.centre(i).y - line;
          ASSERT_NEAR(removal[i], line_profile(y), tolerance(y, pitch)) << "y " << y << " pitch " << pitch;
          if (std::abs(y) < 0.8 * kLineRadius) worst = std::max(worst, std::abs(removal[i] - line_profile(y)));
        }
        // Away from the rim the error is of second order: h^2 / 24 times |Z''| < 5 Z(0) / R^2, and the disc's own
        // sampling.
        EXPECT_LE(worst, (0.25 * pitch * pitch / (kLineRadius * kLineRadius) + 2e-3) * line_profile(0.0)) << pitch;
      }
    }
  }
}

TEST(LineRemoval, TakesTheVolumeOfTheClosedForm) {
  const double pitch = 0.1;
  const Vector removal = Lines(pitch, {0.03}).removal(false);
  double sum = 0.0;
  for (Index r = 0; r < 141; ++r) sum += removal[r * 5 + 2] * pitch;
  // The integral of the profile over y is the volume rate over the speed.
  const double expected = 2.0 * std::acos(-1.0) / 3.0 * kLineSlope * std::pow(kLineRadius, 3) / kLineSpeed;
  EXPECT_NEAR(sum, expected, 1e-3 * expected);
}

TEST(LineRemoval, IsLargestBesideTheLine) {
  const Vector removal = Lines(0.1, {0.0}).removal(false);
  double middle = removal[70 * 5 + 2], largest = 0.0;
  for (Index r = 0; r < 141; ++r) largest = std::max(largest, removal[r * 5 + 2]);
  EXPECT_GT(largest, 1.05 * middle);  // the disc is slow at its centre
}

TEST(LineRemoval, AddsUpOverLinesAtAnInterval) {
  const double pitch = 0.1, interval = 1.3;
  std::vector<double> ys;
  for (int k = -4; k <= 4; ++k) ys.push_back(interval * k);
  const Lines lines(pitch, ys);
  const Vector removal = lines.removal(false);
  for (Index i = 0; i < lines.map.size(); ++i) {
    double expected = 0.0, slack = 0.0;
    for (double line : ys) {
      const double y = lines.map.centre(i).y - line;
      expected += line_profile(y);
      slack += tolerance(y, pitch);
    }
    ASSERT_NEAR(removal[i], expected, slack) << lines.map.centre(i).y;
  }
}

}  // namespace
}  // namespace dwell
