#pragma once

#include <string>
#include <vector>

#include "core/spectra/spectral_window.h"

namespace dwell {

struct PsdOptions {
  SpectralWindow window;
  Index longest_gap = 4;  // gaps that are bridged (bridge_gaps) [pixels]
  int threads = 1;
};

/// Power spectral density of a map over the plane of spatial frequencies.
///
///   S(fx, fy) = hx hy |sum_pixels w z exp(-2 pi i (fx x + fy y))|^2 / sum w^2   [nm^2 mm^2],  two-sided
///
/// with w the window (0 where there is no data) and hx, hy the pitches. Dividing by sum w^2 makes up for the area that
/// window and missing pixels take away: the integral of S is sum (w z)^2 / sum w^2, the mean square of the map as the
/// window sees it, and noise of a flat spectrum keeps its level whatever the shape of the part. Take the form out of
/// the map first: it would outweigh all else.
struct ArealPsd {
  Index rows = 0, cols = 0;           // of the transform: that of the part's bounding box, zero-padded to a fast size
  double step_x = 0.0, step_y = 0.0;  // between frequencies [1/mm]
  std::vector<double> density;        // rows x (cols / 2 + 1) [nm^2 mm^2]; row r: fy = r step_y, or (r - rows) step_y
  double mean_square = 0.0;           // integral of the density [nm^2]
  double length_x = 0.0, length_y = 0.0;    // of the part [mm]: a longer wavelength is not resolved
  double nyquist_x = 0.0, nyquist_y = 0.0;  // half a sample a pixel [1/mm]
  Index bridged = 0;                        // lost pixels filled
  bool holes = false;                       // whether the window follows the edge of the part (window_weights)

  Index half_cols() const { return cols / 2 + 1; }
  double frequency_y(Index row) const { return step_y * static_cast<double>(row <= rows / 2 ? row : row - rows); }
  /// How many of the two-sided frequencies a column stands for: 1 or 2.
  double multiplicity(Index col) const { return col == 0 || 2 * col == cols ? 1.0 : 2.0; }
  double longest_wavelength() const { return length_x > length_y ? length_x : length_y; }
  double shortest_wavelength() const { return 1.0 / (nyquist_x > nyquist_y ? nyquist_x : nyquist_y); }
};

/// Throws InputError if no pixel is finite. Cost: one FFT of the bounding box.
ArealPsd areal_psd(const HeightMap& map, const PsdOptions& options);

/// A spectrum along one frequency.
struct PsdCurve {
  std::string name;               // "x", "y", "radial"
  std::string unit;               // "nm^2 mm" or "nm^2 mm^2"
  std::vector<double> frequency;  // ascending, > 0 [1/mm]
  std::vector<double> density;
  /// Where it means something: from two periods on the part (on its shorter side for the radial one; below, the width
  /// of the window and the form taken out rule) to half a sample a pixel.
  double resolved_from = 0.0, resolved_to = 0.0;
};

/// One-sided spectrum of profiles along x, averaged over y: 2 integral S(fx, fy) dfy [nm^2 mm]. It is the mean of the
/// rows' periodograms, weighted as their pixels are. Its integral over fx > 0 is the mean square without what is
/// constant along x. Likewise along y.
PsdCurve psd_along_x(const ArealPsd& psd);
PsdCurve psd_along_y(const ArealPsd& psd);

/// Mean of S over rings of the width 1 / length of the shorter side (finer ones would see one direction only), centred
/// on its multiples [nm^2 mm^2]; the frequency is the mean over the ring. Up to the lower of the two Nyquist
/// frequencies: rings beyond are not closed.
PsdCurve radial_psd(const ArealPsd& psd);

/// Mean squares [nm^2] of the parts of S with |f| in [edges_k, edges_(k+1)), edges ascending, from 0 before the first
/// to infinity after the last: edges.size() + 1 values whose sum is psd.mean_square.
std::vector<double> band_mean_squares(const ArealPsd& psd, const std::vector<double>& edges);

}  // namespace dwell
