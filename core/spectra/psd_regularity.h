#pragma once

#include "core/base/point.h"
#include "core/spectra/psd.h"

namespace dwell {

/// How regular a surface is in a band of wavelengths: noise has no peak and no direction, marks of a tool have both.
struct PsdRegularity {
  double mean = 0.0;        // density, averaged over the band of the plane of frequencies [nm^2 mm^2]
  double peak = 0.0;        // the largest density in the band [nm^2 mm^2]
  Point frequency;          // where, fx >= 0 [1/mm]
  double rms = 0.0;         // of the band [nm]
  double anisotropy = 0.0;  // |sum S exp(2 i phi)| / sum S over the band: 0 none or fourfold .. 1 one direction
  /// Of 12 directions of 15 degrees, the mean density of the strongest over `mean`: 1 no direction .. about 12 one.
  double sector_over_mean = 0.0;

  double peak_over_mean() const { return peak / mean; }
  double wavelength() const { return 1.0 / length(frequency); }  // of the peak [mm]
  double direction() const;  // across the peak's ripples, counter-clockwise from +x [deg], 0 <= direction < 180
};

/// Over 1/longest <= |f| < 1/shortest [mm], 0 < shortest < longest. The largest density of noise of a flat spectrum is
/// the mean times about the logarithm of the number of frequencies. Throws InputError naming the band if it is empty,
/// holds no frequency of the transform, or nothing but zeros. Cost O(frequencies).
PsdRegularity psd_regularity(const ArealPsd& psd, double shortest, double longest);

}  // namespace dwell
