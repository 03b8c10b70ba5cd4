#include "runs/plan/usual_smoothness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr double kSigmasAFwhm = 2.3548200450309493;  // 2 sqrt(2 ln 2)

double equivalent_sigma_mm(const Part& part) {
  const double square = part.kernel.energy * part.map.grid.pitch_x * part.map.grid.pitch_y;  // integral of b^2
  return std::sqrt(part.tif.volume * part.tif.volume / (4.0 * std::numbers::pi * square));
}

/// Mean distance of dwell points that follow each other without a lift [mm]; 0 if none do.
double mean_step(const LaidPath& laid) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t j = 1; j < laid.strokes.size(); ++j) {
    if (laid.path.lifted[j]) continue;
    sum += distance(laid.path.points[j - 1], laid.path.points[j]);
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

/// Dwell points per area of the part [1/mm^2]. Of a path that runs beside the part alone, all of them count.
double points_per_area(const Part& part, const LaidPath& laid) {
  const Grid& grid = part.map.grid;
  std::size_t inside = 0;
  for (const Point& p : laid.path.points) {
    const Index row = std::lround((p.y - grid.origin.y) / grid.pitch_y),
                col = std::lround((p.x - grid.origin.x) / grid.pitch_x);
    if (row < 0 || row >= grid.rows || col < 0 || col >= grid.cols) continue;
    inside += std::isfinite(part.map.values[static_cast<std::size_t>(grid.index(row, col))]) ? 1 : 0;
  }
  const double area = static_cast<double>(part.map.valid_pixels()) * grid.pitch_x * grid.pitch_y;
  return static_cast<double>(inside > 0 ? inside : laid.path.points.size()) / area;
}

}  // namespace

double equivalent_fwhm(const Part& part) { return kSigmasAFwhm * equivalent_sigma_mm(part); }

double usual_smoothness(const Part& part, const LaidPath& laid) {
  const double step = mean_step(laid);
  if (!(step > 0.0)) return 0.0;
  constexpr double kWave = 2.0 * std::numbers::pi / (kHalfHeldWave * kSigmasAFwhm);  // u
  const double sigma = equivalent_sigma_mm(part), square = sigma * sigma;
  const double weight = 4.0 * std::numbers::pi * square * square * points_per_area(part, laid) *
                        std::exp(-kWave * kWave) / (step * step * kWave * kWave);
  return std::min(weight, ranges::kWeight.most);
}

}  // namespace dwell
