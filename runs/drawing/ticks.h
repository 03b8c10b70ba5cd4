#pragma once

#include <string>
#include <vector>

namespace dwell {

/// Round values along an axis, ascending, and what is printed at them.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
};

/// The multiples of the smallest round step (1, 2 or 5 times a power of ten) that lie in [lower, upper] and are at
/// most `most` in number; at least one is returned unless the range is too narrow for its own rounding, when the
/// lower end is. Labels carry just the decimals of the step; exponents for magnitudes from 1e6 on and below 1e-3.
/// Throws std::invalid_argument unless lower < upper, both finite, and most >= 1.
Ticks round_ticks(double lower, double upper, int most);

}  // namespace dwell
