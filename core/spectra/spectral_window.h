#pragma once

#include <string>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// How a map fades to zero towards its edge before it is transformed, so that the step there does not leak into all
/// frequencies. `t` runs from 0 at the edge to 1 in the middle.
///   hann       sin^2(pi t / 2)
///   tukey:R    sin^2(pi t / (2 R)) for t < R, 1 beyond; 0 < R <= 1; R = 1 is hann
///   none       1
struct SpectralWindow {
  enum class Kind { Hann, Tukey, None } kind = Kind::Hann;
  double taper = 1.0;  // R

  double operator()(double t) const;
};

/// Throws InputError naming the text and what is accepted.
SpectralWindow parse_spectral_window(const std::string& text);
std::string to_string(const SpectralWindow& window);

/// Weights of the map's pixels, 0 where there is no data.
/// A map without holes: the product of the windows along x and y, t = distance of the pixel's centre from the nearer
/// edge over half the width. Any other: t = distance to the nearest edge of the part or of a hole over the largest such
/// distance (on a disc, the radial Hann window; the distance to a missing pixel's centre less half the smaller pitch).
/// Cost O(pixels).
std::vector<double> window_weights(const HeightMap& map, const SpectralWindow& window, int threads = 1);

/// Fills gaps of at most `longest` pixels between valid ones, first within rows, then within columns, by a straight
/// line from end to end, so that single lost pixels do not count as edges of the part. Returns how many pixels were
/// filled.
Index bridge_gaps(HeightMap& map, Index longest);

}  // namespace dwell
