#include "paths/metrics/ripple_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "core/spectra/psd.h"

namespace dwell {
namespace {

constexpr std::size_t kSectors = 36;
constexpr std::size_t kMostPeaks = 8;
constexpr double kLeastShare = 0.01;
constexpr double kDirectionRounding = 1e-6;  // degrees: a direction along y is always 90, not sometimes -90
constexpr double kLobe = 2.5;                // half the main lobe of a Hann window is two frequencies wide

/// A spectrum from which peaks can be taken out.
struct Spectrum {
  ArealPsd psd;
  double lowest, highest;  // frequencies of the band [1/mm]

  Point frequency(Index row, Index col) const { return {psd.step_x * static_cast<double>(col), psd.frequency_y(row)}; }
  bool in_band(Point f) const {
    const double amount = length(f);
    return amount >= lowest && amount <= highest;
  }
  double& density(Index row, Index col) { return psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)]; }
  double cell() const { return psd.step_x * psd.step_y; }
};

template <typename Visit>
void for_band(Spectrum& s, Visit visit) {
  for (Index row = 0; row < s.psd.rows; ++row) {
    for (Index col = 0; col < s.psd.half_cols(); ++col) {
      if (s.in_band(s.frequency(row, col))) visit(row, col);
    }
  }
}

std::size_t sector_of(Point f) {
  const double turns = std::atan2(f.y, f.x) / std::numbers::pi;  // opposite directions differ by one
  const double share = turns - std::floor(turns);
  return std::min(kSectors - 1, static_cast<std::size_t>(share * static_cast<double>(kSectors)));
}

/// Half the sum of the differences between the shares of power and of frequencies.
double anisotropy_of(Spectrum& s, double mean_square) {
  std::array<double, kSectors> power{}, count{};
  double frequencies = 0.0;
  for_band(s, [&](Index row, Index col) {
    const double multiplicity = s.psd.multiplicity(col);
    const std::size_t sector = sector_of(s.frequency(row, col));
    power[sector] += multiplicity * s.density(row, col) * s.cell();
    count[sector] += multiplicity;
    frequencies += multiplicity;
  });
  double differences = 0.0;
  for (std::size_t k = 0; k < kSectors; ++k) differences += std::abs(power[k] / mean_square - count[k] / frequencies);
  return 0.5 * differences;
}

/// Sums the power about a frequency and its opposite and takes it out. Of each pair of opposite frequencies the
/// spectrum holds the one with col >= 0, and both of col = 0.
RipplePeak take_out(Spectrum& s, Index at_row, Index at_col, double mean_square) {
  const double radius_x = kLobe / s.psd.length_x, radius_y = kLobe / s.psd.length_y;
  const auto reach_x = static_cast<Index>(radius_x / s.psd.step_x);
  const auto reach_y = static_cast<Index>(radius_y / s.psd.step_y);
  double power = 0.0;
  Point centre;
  for (const Index sign : {1, -1}) {
    for (Index dr = -reach_y; dr <= reach_y; ++dr) {
      for (Index dc = -reach_x; dc <= reach_x; ++dc) {
        const double u = s.psd.step_x * static_cast<double>(dc) / radius_x;
        const double v = s.psd.step_y * static_cast<double>(dr) / radius_y;
        const Index col = sign * at_col + dc;
        if (u * u + v * v > 1.0 || col < 0 || col >= s.psd.half_cols()) continue;
        const Index row = ((sign * at_row + dr) % s.psd.rows + s.psd.rows) % s.psd.rows;
        const Point f = s.frequency(row, col);
        if (!s.in_band(f)) continue;
        const double part = s.psd.multiplicity(col) * s.density(row, col) * s.cell();
        s.density(row, col) = 0.0;
        power += part;
        centre = centre + (static_cast<double>(sign) * part) * f;
      }
    }
  }
  const Point f = (1.0 / power) * centre;
  double direction = std::atan2(f.y, f.x) * 180.0 / std::numbers::pi;
  if (direction > 90.0 + kDirectionRounding) direction -= 180.0;
  if (direction <= -90.0 + kDirectionRounding) direction += 180.0;
  return {1.0 / length(f), direction, std::sqrt(power), power / mean_square};
}

std::vector<RipplePeak> peaks_of(Spectrum& s, double mean_square) {
  std::vector<RipplePeak> peaks;
  for (std::size_t tries = 0; tries < kMostPeaks; ++tries) {
    Index best_row = 0, best_col = 0;
    double best = 0.0;
    for_band(s, [&](Index row, Index col) {
      if (s.density(row, col) <= best) return;
      best = s.density(row, col);
      best_row = row, best_col = col;
    });
    if (!(best > 0.0)) break;
    const RipplePeak peak = take_out(s, best_row, best_col, mean_square);
    if (peak.share >= kLeastShare) peaks.push_back(peak);
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return peaks;
}

}  // namespace

RippleSpectrum ripple_spectrum(const HeightMap& map, const RippleBand& band, int threads) {
  if (!(band.shortest > 0.0 && band.longest > band.shortest && std::isfinite(band.longest))) {
    throw InputError(fmt::format("ripple: band = {} to {} mm; required 0 < shortest < longest, finite", band.shortest,
                                 band.longest));
  }
  PsdOptions options;
  options.threads = threads;
  Spectrum s{areal_psd(without_form(map, {true, true, false, false}, threads), options), 1.0 / band.longest,
             1.0 / band.shortest};
  RippleSpectrum result;
  result.band = band;
  result.resolved = {std::max(band.shortest, s.psd.shortest_wavelength()),
                     std::min(band.longest, 0.5 * s.psd.longest_wavelength())};
  if (!(result.resolved.shortest < result.resolved.longest)) {
    throw InputError(
        fmt::format("ripple: a map of {:.4g} x {:.4g} mm shows wavelengths of {:.4g} to {:.4g} mm, none of the band of "
                    "{} to {} mm; "
                    "required: a larger map or finer pixels",
                    s.psd.length_x, s.psd.length_y, s.psd.shortest_wavelength(), 0.5 * s.psd.longest_wavelength(),
                    band.shortest, band.longest));
  }
  s.lowest = 1.0 / result.resolved.longest;
  s.highest = 1.0 / result.resolved.shortest;
  double mean_square = 0.0;
  for_band(s, [&](Index row, Index col) { mean_square += s.psd.multiplicity(col) * s.density(row, col) * s.cell(); });
  result.rms = std::sqrt(mean_square);
  if (!(mean_square > 0.0)) return result;
  result.anisotropy = anisotropy_of(s, mean_square);
  result.peaks = peaks_of(s, mean_square);
  return result;
}

}  // namespace dwell
