#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Wavelengths that count as mid-spatial error [mm]: 0.12 to 33 in Hou, Liao, Wang 2017 and Zha et al. 2020.
struct RippleBand {
  double shortest = 0.12;
  double longest = 33.0;
};

/// A wave that stands out of the spectrum of a surface.
struct RipplePeak {
  double wavelength = 0.0;     // [mm]
  double direction_deg = 0.0;  // across its crests, -90 < angle <= 90, counter-clockwise from +x
  double rms = 0.0;            // of the wave [nm]; a sine of this RMS has sqrt(8) times that peak to valley
  double share = 0.0;          // of the mean square in the band
};

/// What a surface's mid-spatial error is like.
struct RippleSpectrum {
  RippleBand band;                // as asked for
  RippleBand resolved;            // what of it the map can show: two periods on the part to two pixels a period
  double rms = 0.0;               // of the resolved band [nm]
  double anisotropy = 0;          // 0: alike in all directions; near 1: all in one
  std::vector<RipplePeak> peaks;  // strongest first, at most 8, each at least 1 % of the band's mean square
};

/// Takes out piston and tilt and sums the areal power spectral density (core/spectra/psd.h, Hann window) over the band.
///
/// rms^2 is the integral over the band. Anisotropy: the shares of that mean square in 36 sectors of directions (5
/// degrees each, opposite ones together) against the shares of the frequencies in them, half the sum of the
/// differences' amounts. A raster's lines give nearly 1, two crossed directions about the same, an isotropic random
/// surface of n frequencies about 2.4 / sqrt(n). A peak is the power within 2.5 frequency steps (1 / length of the
/// part) of a highest density, its wavelength that of the centre of that power; then the next outside it.
///
/// Throws InputError if the band is not 0 < shortest < longest and finite, no pixel is finite, or the map shows nothing
/// of the band. Cost: one FFT of the map and ten passes over its spectrum.
RippleSpectrum ripple_spectrum(const HeightMap& map, const RippleBand& band = {}, int threads = 1);

}  // namespace dwell
