#pragma once

#include <string>

namespace dwell {

/// Numbers as exports write them: decimal, never with an exponent (many controllers cannot read one), never "-0".
/// Values must be finite; those of the `digits_*` functions also >= 0. Throw std::logic_error otherwise.

inline constexpr int kExportDigits = 9;  // significant digits of dwell, feed and duration

std::string coordinate_text(double mm);      // to 1e-6 mm, nearest
std::string seconds_text(double s);          // to 1e-9 s, nearest; >= 0
std::string inches_text(double mm);          // in inches, to 1e-8 of them (2.5e-7 mm), nearest
std::string digits_nearest(double value);    // to kExportDigits significant digits
std::string digits_not_above(double value);  // the same, but what is read back is never above the value
std::string digits_not_below(double value);  // ... never below the value

/// The double that a reader makes of one of these texts.
double number_of(const std::string& text);

}  // namespace dwell
