#include "core/spectra/psd_regularity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr std::size_t kSectors = 12;

struct Sector {
  double power = 0.0, frequencies = 0.0;
};

/// Directions from 0 to 180 degrees in sectors of which the first is centred on 0, so that x and y lie in the middle
/// of one.
std::size_t sector_of(double fx, double fy) {
  const double turns = std::atan2(fy, fx) / std::numbers::pi;  // fx >= 0: -1/2 .. 1/2, a direction and its opposite
  const double sector = std::round(turns * kSectors);
  return static_cast<std::size_t>(sector < 0.0 ? sector + kSectors : sector) % kSectors;
}

}  // namespace

double PsdRegularity::direction() const {
  const double degrees = std::atan2(frequency.y, frequency.x) * 180.0 / std::numbers::pi;
  return degrees < 0.0 ? degrees + 180.0 : degrees;
}

PsdRegularity psd_regularity(const ArealPsd& psd, double shortest, double longest) {
  if (!(shortest > 0.0 && shortest < longest && std::isfinite(longest))) {
    throw InputError(
        fmt::format("regularity: band of {} to {} mm; required 0 < shortest < longest, finite", shortest, longest));
  }
  PsdRegularity result;
  std::array<Sector, kSectors> sectors{};
  double power = 0.0, count = 0.0, cosine = 0.0, sine = 0.0;
  for (Index row = 0; row < psd.rows; ++row) {
    const double fy = psd.frequency_y(row);
    for (Index col = 0; col < psd.half_cols(); ++col) {
      const double fx = psd.step_x * static_cast<double>(col), f2 = fx * fx + fy * fy, f = std::sqrt(f2);
      if (!(f * longest >= 1.0 && f * shortest < 1.0)) continue;
      const double density = psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
      const double weight = psd.multiplicity(col);
      Sector& sector = sectors[sector_of(fx, fy)];
      sector.power += weight * density;
      sector.frequencies += weight;
      power += weight * density;
      count += weight;
      cosine += weight * density * (fx * fx - fy * fy) / f2;
      sine += weight * density * 2.0 * fx * fy / f2;
      if (density > result.peak) {
        result.peak = density;
        result.frequency = {fx, fy};
      }
    }
  }
  if (!(power > 0.0)) {
    throw InputError(
        fmt::format("regularity: the spectrum holds {} frequencies from {} to {} mm{}; required: a band it "
                    "resolves, with something in it",
                    count, shortest, longest, count > 0.0 ? " and nothing at any of them" : ""));
  }
  result.mean = power / count;
  result.rms = std::sqrt(power * psd.step_x * psd.step_y);
  result.anisotropy = std::hypot(cosine, sine) / power;
  for (const Sector& sector : sectors) {
    if (sector.frequencies > 0.0) {
      result.sector_over_mean = std::max(result.sector_over_mean, sector.power / sector.frequencies / result.mean);
    }
  }
  return result;
}

}  // namespace dwell
