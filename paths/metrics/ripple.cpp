#include "paths/metrics/ripple.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid.h"

namespace dwell {
namespace {

constexpr Index kPositions = 512;
constexpr double kMostLines = 1e5;  // across the profile

}  // namespace

PeriodicSum periodic_sum(const TrackProfile& profile, double spacing, const char* what) {
  const double width = profile.high - profile.low;
  if (!(std::isfinite(spacing) && spacing >= width / kMostLines)) {
    throw InputError(
        fmt::format("{} = {} mm; required finite and >= {:.3g} mm, a hundred-thousandth of the track's width", what,
                    spacing, width / kMostLines));
  }
  std::array<double, kPositions> sum{};
  double mean = 0.0;
  for (Index i = 0; i < kPositions; ++i) {
    const double v = spacing * static_cast<double>(i) / static_cast<double>(kPositions);
    const auto first = static_cast<Index>(std::ceil((profile.low - v) / spacing));
    const auto last = static_cast<Index>(std::floor((profile.high - v) / spacing));
    double& s = sum[static_cast<std::size_t>(i)];
    for (Index k = first; k <= last; ++k) s += profile.value(v + spacing * static_cast<double>(k));
    mean += s / static_cast<double>(kPositions);
  }
  PeriodicSum result{mean, sum[0], sum[0], 0.0};
  for (const double s : sum) {
    result.low = std::min(result.low, s);
    result.high = std::max(result.high, s);
    result.deviation += (s - mean) * (s - mean) / static_cast<double>(kPositions);
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

RasterRipple raster_ripple(const TrackProfile& line, double pitch, double depth) {
  if (!(std::isfinite(depth) && depth > 0.0)) {
    throw InputError(fmt::format("ripple: depth = {} nm; required finite and > 0", depth));
  }
  const PeriodicSum sum = periodic_sum(line, pitch, "ripple: pitch");
  if (!(sum.mean > 0.0)) {
    throw InputError(
        fmt::format("ripple: lines {} mm apart remove {} nm mm/s on average; required > 0", pitch, sum.mean));
  }
  RasterRipple ripple{pitch, depth, sum.mean / depth, 0.0, (sum.high - sum.low) / sum.mean, 0.0};
  ripple.pve = ripple.pvn * depth;
  ripple.rms = sum.deviation / sum.mean * depth;
  return ripple;
}

}  // namespace dwell
