#include "solvers/fits/registration_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/map/map_decimate.h"
#include "core/map/robust_plane.h"
#include "core/numerics/plane_transform.h"

namespace dwell {
namespace {

/// The map averaged over blocks of about `pitch` mm, less its plane: a robust one, which a smudge on one map does not
/// tilt.
HeightMap average_blocks(const HeightMap& map, double pitch) {
  const auto factor = [&](double own, Index pixels) {
    return std::clamp<Index>(static_cast<Index>(std::llround(pitch / own)), 1, std::max<Index>(1, pixels / 2));
  };
  HeightMap coarse =
      decimate_map(map, factor(map.grid.pitch_y, map.grid.rows), factor(map.grid.pitch_x, map.grid.cols));
  const std::vector<Index> pixels = finite_pixels(coarse);
  if (pixels.size() < 3) return coarse;
  const Plane plane = robust_plane(coarse, pixels, true);
  for (const Index i : pixels) coarse.values[static_cast<std::size_t>(i)] -= plane.at(coarse.grid.centre(i));
  return coarse;
}

struct HeightSample {
  Point place;
  double height;
};

/// The variance of the difference, or infinity for too little overlap.
double mismatch(const std::vector<HeightSample>& samples, const PlaneTransform& forward, const HeightMap& fixed,
                double needed) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const HeightSample& s : samples) {
    const Point p = forward(s.place);
    const double col = std::round((p.x - fixed.grid.origin.x) / fixed.grid.pitch_x);
    const double row = std::round((p.y - fixed.grid.origin.y) / fixed.grid.pitch_y);
    if (!(col >= 0.0 && row >= 0.0 && col < static_cast<double>(fixed.grid.cols) &&
          row < static_cast<double>(fixed.grid.rows))) {
      continue;
    }
    const double d = fixed.at(static_cast<Index>(row), static_cast<Index>(col)) - s.height;
    if (!std::isfinite(d)) continue;
    sum += d, squares += d * d, count += 1.0;
  }
  if (!(count >= needed && count > 0.0)) return std::numeric_limits<double>::infinity();
  return squares / count - sum * sum / (count * count);
}

Index steps_of(double range, double step) { return static_cast<Index>(std::min(std::ceil(range / step - 1e-9), 1e4)); }

double count_of(Index steps) { return 2.0 * static_cast<double>(steps) + 1.0; }

}  // namespace

RegistrationStart coarse_registration(const HeightMap& moving, const HeightMap& fixed, const RegistrationRange& range,
                                      int threads, const Progress& progress) {
  const Grid& g = fixed.grid;
  const double area = g.width() * g.height() / static_cast<double>(kStartPixels);
  const double pitch = std::max(std::sqrt(area), std::min(g.pitch_x, g.pitch_y));
  const HeightMap a = average_blocks(moving, pitch), b = average_blocks(fixed, pitch);
  const Point middle = middle_of(moving.grid);
  std::vector<HeightSample> samples;
  for (const Index i : finite_pixels(a)) samples.push_back({a.grid.centre(i), a.values[static_cast<std::size_t>(i)]});
  const double pixel_ratio = b.grid.pitch_x * b.grid.pitch_y / (a.grid.pitch_x * a.grid.pitch_y);
  const double needed = kStartOverlap * std::min(static_cast<double>(samples.size()),
                                                 pixel_ratio * static_cast<double>(b.valid_pixels()));
  const double corner = 0.5 * std::hypot(moving.grid.width(), moving.grid.height());
  const double turn_step = std::min(b.grid.pitch_x, b.grid.pitch_y) / corner * 180.0 / std::numbers::pi;
  const Index turns = steps_of(range.degrees, turn_step), across = steps_of(range.shift, b.grid.pitch_x),
              along = steps_of(range.shift, b.grid.pitch_y);
  const Index places = (2 * turns + 1) * (2 * across + 1) * (2 * along + 1);
  constexpr double kMostPlaces = 5e7;
  if (const double asked = count_of(turns) * count_of(across) * count_of(along); !(asked <= kMostPlaces)) {
    throw InputError(fmt::format(
        "registration: shifts up to {} mm and rotations up to {} degrees are {:.3g} places to try, {:.4g} mm and "
        "{:.4g} "
        "degrees apart; at most {:.0e} accepted, give a smaller range",
        range.shift, range.degrees, asked, std::min(b.grid.pitch_x, b.grid.pitch_y), turn_step, kMostPlaces));
  }
  const auto start_of = [&](Index place) {
    const auto step = [&](Index count, double size) {
      const Index k = place % (2 * count + 1) - count;
      place /= 2 * count + 1;
      return static_cast<double>(k) * size;
    };
    const double dx = step(across, b.grid.pitch_x), dy = step(along, b.grid.pitch_y);
    return RegistrationStart{{dx, dy}, step(turns, turn_step)};
  };
  std::vector<double> score(static_cast<std::size_t>(places));
  // Places tried between two questions whether to stop, about a tenth of a second.
  constexpr Index kBetweenLooks = 4096;
  for (Index begin = 0; begin < places; begin += kBetweenLooks) {
    progress.step(fmt::format("registration: coarse start, {} of {} places", begin, places));
    const Index end = std::min(begin + kBetweenLooks, places);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (Index place = begin; place < end; ++place) {
      const RegistrationStart s = start_of(place);
      score[static_cast<std::size_t>(place)] =
          mismatch(samples, similarity(middle, s.shift, s.degrees, 1.0), b, needed);
    }
  }
  const auto best = std::min_element(score.begin(), score.end());
  if (!std::isfinite(*best)) {
    throw InputError(
        fmt::format("registration: the maps overlap by less than {:.0f} % for every shift up to {} mm; give a larger "
                    "range, or shift one before",
                    100.0 * kStartOverlap, range.shift));
  }
  return start_of(best - score.begin());
}

}  // namespace dwell
