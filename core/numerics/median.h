#pragma once

#include <vector>

namespace dwell {

/// The middle one of the values; the upper of the two middle ones if their number is even. At least one value, no NaN.
/// Cost O(n) on average.
double upper_median(std::vector<double> values);

/// Standard deviation per median absolute deviation of normal noise: times it, a median of absolute values estimates
/// the standard deviation, and outliers hardly count.
inline constexpr double kSigmaPerMedianDeviation = 1.4826;

}  // namespace dwell
