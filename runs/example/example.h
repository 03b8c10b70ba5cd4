#pragma once

#include <cstdint>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// A made-up but realistic mirror. Heights and amplitudes [nm], lengths [mm]. The defaults are the demo's: a round
/// mirror of 100 mm with about 60 nm RMS once piston and tilt are removed, without any symmetry, so that a flip, a
/// transposition or a half turn of the map shows.
struct ExampleOptions {
  enum class Shape { Round, Rectangle } shape = Shape::Round;
  double width = 100.0;   // along x, > 0; the diameter of a round mirror
  double height = 100.0;  // along y, > 0; not used by a round mirror
  double hole = 0.0;      // diameter of a central hole, >= 0; 0 = none. Round only
  double pitch = 0.5;     // of the pixels, > 0; 2 to 4096 pixels an edge
  std::uint64_t seed = 1;

  // Form: Zernike terms on the circumscribed disc (radius 1), each with this PV over the whole disc. Any sign.
  double power = 170.0;          // 2 r^2 - 1
  double astigmatism = 135.0;    // r^2 cos 2t
  double astigmatism45 = 100.0;  // r^2 sin 2t
  double coma_x = 150.0;         // (3 r^3 - 2 r) cos t
  double coma_y = -75.0;         // (3 r^3 - 2 r) sin t
  double trefoil = 85.0;         // r^3 cos 3t
  double spherical = 110.0;      // 6 r^4 - 6 r^2 + 1

  // A round bump at (0.25 width, 0.15 height) from the middle, Gaussian with a FWHM of 0.12 width.
  double bump = 120.0;

  // Roughness: an isotropic random surface with the two-dimensional power spectral density C(f) [nm^2 mm^2]
  // proportional to f^roughness_slope, f [1/mm] the radial frequency, from 1 / (longer edge) to 1 / (2 pitch). (A
  // profile cut from it then falls as f^(slope + 1).) Scaled to this RMS about its mean on the pixels of the mirror.
  double roughness_rms = 15.0;    // >= 0
  double roughness_slope = -3.0;  // -6 to 0

  double edge_rolloff = 150.0;  // the edge is lower by this, decaying inwards as exp(-distance / edge_width)
  double edge_width = 2.5;      // > 0
  double noise_rms = 0.5;       // of the measurement: white, Gaussian, >= 0
};

/// The mirror, centred on (0, 0); NaN outside it. The same options give the same map on every platform, to rounding
/// of the mathematical library. Throws InputError naming the field, its value, and what is accepted.
/// Throws Interrupted. Cost O(400 pixels).
HeightMap example_mirror(const ExampleOptions& options = {}, const Progress& progress = {});

/// A made-up removal function, as measured from a spot. Rates [nm/s], lengths [mm].
struct ExampleTifOptions {
  double peak = 8.0;          // > 0
  double fwhm = 6.0;          // > 0; diameter of the disc with the area where the rate is above half of the peak
  double pitch = 0.25;        // > 0
  double half_width = 8.0;    // of the square grid, >= fwhm / 2; at most 4096 pixels an edge
  double ellipticity = 1.15;  // long over short axis, >= 1
  double angle = 25.0;        // of the long axis, from +x to +y [degrees]
  double shear = 0.08;        // -1 to 1: slants the ellipse
  double skew = 0.08;      // -0.5 to 0.5: the tail towards the long axis is longer by this fraction, the other shorter
  double offset_x = 0.20;  // where the peak is, from the middle of the grid
  double offset_y = -0.15;
  double noise_rms = 0.01;  // white, Gaussian, >= 0 [nm/s]; a few samples in the wings are negative
  std::uint64_t seed = 2;
};

/// The spot on its own grid, whose middle is (0, 0) and whose pixels are odd in number. Throws InputError naming the
/// field, its value, and what is accepted.
HeightMap example_tif(const ExampleTifOptions& options = {});

}  // namespace dwell
