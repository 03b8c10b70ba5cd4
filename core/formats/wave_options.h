#pragma once

#include <optional>

namespace dwell {

/// What a user says of values in waves, and of optical path differences.
struct WaveOptions {
  bool in_waves = false;             // the values are waves
  std::optional<double> wavelength;  // of one wave [nm], > 0
  /// The height of the surface for each wave, in wavelengths, or for each nm of path difference, in nm; > 0. It is 0.5
  /// of a mirror measured at normal incidence, where the light goes there and back, and 1 where the values are heights
  /// of the surface.
  std::optional<double> scale;
};

}  // namespace dwell
