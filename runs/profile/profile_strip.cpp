#include "runs/profile/profile_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/numerics/cubic_spline.h"

namespace dwell {
namespace {

/// Whether every place lies on the pixel of its number, to a millionth of a pixel.
bool lies_evenly(const std::vector<double>& x, double pitch) {
  constexpr double kEven = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(x[i] - x[0] - pitch * static_cast<double>(i)) > kEven * pitch) return false;
  }
  return true;
}

/// The pitch of the pixels: the median distance, or the mean one where that makes the places lie evenly, which a
/// rounded median does not over a long profile.
double strip_pitch(const ProfileInput& profile) {
  const std::vector<double>& x = profile.measured.x;
  const double mean = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  return lies_evenly(x, mean) ? mean : profile.spacing.median;
}

double strip_rows(double width_mm, double pitch) {
  if (width_mm == 0.0) return 1.0;
  const double rows = std::round(width_mm / pitch);
  if (rows >= 1.0 && std::abs(width_mm - rows * pitch) <= 0.01 * pitch) return rows;
  throw InputError("line width", fmt::format("{} mm", width_mm),
                   fmt::format("a multiple of the {:.9g} mm of a pixel", pitch));
}

}  // namespace

HeightMap profile_strip(const ProfileInput& profile, double width_mm) {
  constexpr double kSlack = 1e-9;
  const LineProfile& rest = profile.rest.profile;
  const double pitch = strip_pitch(profile), rows = strip_rows(width_mm, pitch);
  const double cols = std::floor((rest.x.back() - rest.x.front()) / pitch * (1.0 + kSlack)) + 1.0;
  const Point origin{rest.x.front(), -0.5 * pitch * (rows - 1.0)};
  HeightMap map(limited_grid(rows, cols, {pitch, pitch}, origin, "the strip of the profile"));
  std::vector<double> line = rest.height;
  if (!lies_evenly(rest.x, pitch)) {
    const CubicSpline spline(rest.x, rest.height);
    line.resize(static_cast<std::size_t>(map.grid.cols));
    for (Index col = 0; col < map.grid.cols; ++col) line[static_cast<std::size_t>(col)] = spline.value(map.grid.x(col));
  }
  for (Index row = 0; row < map.grid.rows; ++row)
    std::copy(line.begin(), line.end(), map.values.begin() + static_cast<std::ptrdiff_t>(row * map.grid.cols));
  const std::string pole = profile.rest.pole ? fmt::format(" with its pole at x = {:.6g} mm", *profile.rest.pole) : "";
  map.history.push_back(fmt::format("profile without {}{}, the same in every row", profile.form.text, pole));
  return map;
}

}  // namespace dwell
