#pragma once

#include <string>
#include <vector>

namespace dwell {

struct TextStyle;

enum class AxisScale { Logarithmic, Linear };
enum class AxisDirection { Across, Up };

/// Round values along an axis, ascending, and what is printed at them.
struct AxisTicks {
  std::vector<double> values;
  std::vector<std::string> labels;
};

/// What an axis shows: its scale and the values at its ends.
struct AxisRange {
  AxisScale scale = AxisScale::Linear;
  double lower = 0.0, upper = 1.0;  // lower < upper; on a logarithmic axis both > 0

  /// Where a value lies, from 0 at the lower end to 1. A value outside of the range, or one that the scale cannot show,
  /// lies at an end.
  double share(double value) const;
  /// Whether the scale can show the value.
  bool holds(double value) const;
  /// As many ticks as have room for their labels along `length` units, but at most ten.
  AxisTicks ticks(double length, AxisDirection direction, const TextStyle& style) const;
};

/// The multiples of the smallest round step (1, 2 or 5 times a power of ten) that lie in [lower, upper] and are at most
/// `most` in number; at least one is returned. If the range is too narrow for its own rounding, that is the lower end.
/// Labels carry just the decimals of the step; exponents for magnitudes from 1e6 on and below 1e-3. Throws
/// std::invalid_argument unless lower < upper, both finite, and most >= 1.
AxisTicks round_ticks(double lower, double upper, int most);

/// Ticks of a logarithmic axis: 1, 2, 5 times powers of ten, powers of ten alone where these are more than `most`, or
/// round_ticks where the range is too narrow for three of them. Throws std::invalid_argument unless 0 < lower < upper,
/// both finite, and most >= 3.
AxisTicks log_ticks(double lower, double upper, int most);

}  // namespace dwell
