#pragma once

#include <optional>
#include <vector>

#include "runs/drawing/colour.h"

namespace dwell {

/// How numbers become colours.
///   Sequential  viridis (S. van der Walt, N. Smith, matplotlib 2015, CC0), perceptually uniform: dwell, rates
///   Diverging   blue - white - red, equally dark at equal distances from zero: heights about zero, red = high
///               (P. Kovesi, "Good colour maps: how to design them", 2015, arXiv:1509.03700, map CET-D1A =
///               diverging_bwr_20-95_c54: lightness 20 at both ends, in equal steps to the middle)
enum class ColourMap { Sequential, Diverging };

inline constexpr Colour kNoDataColour{208, 208, 208};

/// Colour of a fraction of the range: clamped to [0, 1], interpolated in a short table; NaN is kNoDataColour.
Colour colour_at(ColourMap map, double fraction);

/// The range of a colour bar and the range of the values it shows.
struct ColourLimits {
  double lower = 0.0;
  double upper = 1.0;
  double smallest = 0.0;  // of the finite values
  double largest = 0.0;
  bool any = false;  // false: no finite value at all

  bool clips_below() const { return any && smallest < lower; }
  bool clips_above() const { return any && largest > upper; }
  double fraction(double value) const { return (value - lower) / (upper - lower); }
};

/// Limits of the colours for these values; those that are not finite are ignored.
/// Diverging: symmetric about zero, so that white is zero and both signs have the same scale. By default the full
/// range, +-max |v|, as an optician expects; but no more than 1.5 times the 99.5 % quantile of |v|, so that a few
/// spikes (dust, edge pixels) do not bleach the rest. One limit given sets the other.
/// Sequential: by default from the smallest to the largest, each no farther beyond the 0.5 % and 99.5 % quantiles
/// than half of the distance between them. Of more than a million values, quantiles are those of some million taken at
/// equal distances.
/// Throws InputError if a given limit is not finite, lower >= upper, or a diverging scale is not given zero inside.
/// Cost O(values).
ColourLimits colour_limits(const std::vector<double>& values, ColourMap map, std::optional<double> lower = {},
                           std::optional<double> upper = {});

/// The limits that were chosen for other values, applied to these: what is cut off is that of these values.
ColourLimits same_limits(const ColourLimits& chosen, const std::vector<double>& values);

}  // namespace dwell
