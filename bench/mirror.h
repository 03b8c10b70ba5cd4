#pragma once

#include <cstdint>

#include "core/map/height_map.h"

namespace dwell::bench {

/// A made-up error map of n x n pixels: white noise filtered to the two-dimensional power spectral density
/// C(f) ~ f^-3, cut from a field a quarter larger so that opposite edges do not match, mean zero, `rms` [nm]. Pitch
/// [mm], centred on (0, 0). The same seed gives the same map, to rounding of the mathematical library and of FFTW.
HeightMap noise_mirror(Index n, double pitch, double rms, std::uint64_t seed);

/// Sets to NaN what lies outside the ring inner <= r <= outer about (0, 0) [mm].
void cut_ring(HeightMap& map, double inner, double outer);

}  // namespace dwell::bench
