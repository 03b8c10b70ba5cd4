#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Wavelengths that count as mid-spatial error [mm]: 0.12 to 33 in Hou, Liao, Wang 2017 and Zha et al. 2020.
struct RippleBand {
  double shortest = 0.12;
  double longest = 33.0;
};

/// A wave that stands out in the spectrum of a surface.
struct RipplePeak {
  double wavelength = 0.0;     // [mm]
  double direction_deg = 0.0;  // across its crests, -90 < angle <= 90, counter-clockwise from +x
  double rms = 0.0;            // of the wave [nm]; a sine of this RMS has sqrt(8) times that peak to valley
  double share = 0.0;          // of the mean square in the band
};

/// The mid-spatial error of a surface.
struct RippleSpectrum {
  RippleBand band;        // as asked for
  RippleBand resolved;    // the part of it that the map can show: from two periods on the part to two pixels a period
  double rms = 0.0;       // of the resolved band [nm]
  double anisotropy = 0;  // 0: alike in all directions; near 1: all in one
  std::vector<RipplePeak> peaks;  // strongest first, at most 8, each at least 1 % of the band's mean square
};

/// Takes out piston and tilt and sums the areal power spectral density (core/spectra/psd.h, Hann window) over the band.
///
/// rms^2 is the integral over the band. The anisotropy compares, in 36 sectors of directions (5 degrees each, opposite
/// ones together), the share of that mean square with the share of the frequencies: it is half the sum of the absolute
/// differences. A raster's lines give nearly 1, two crossed directions about the same, an isotropic random surface of n
/// frequencies about 2.4 / sqrt(n). A peak is the power within 2.5 frequency steps (1 / length of the part) of the
/// highest density, and its wavelength is that of the centre of this power; the next peak is sought outside of it.
///
/// Throws InputError if the band is not 0 < shortest < longest and finite, no pixel is finite, or the map can show no
/// part of the band. Cost: one FFT of the map and ten passes over its spectrum.
RippleSpectrum ripple_spectrum(const HeightMap& map, const RippleBand& band = {}, int threads = 1);

}  // namespace dwell
