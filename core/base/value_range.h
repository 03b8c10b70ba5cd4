#pragma once

#include <string>

namespace dwell {

/// The values that a quantity may have, in its unit, both ends included. What lies beyond is no part, tool or machine,
/// but a slip or another unit: it is refused where it is given, so that no sum, square or size overflows later.
struct ValueRange {
  double least, most;
  const char* unit;  // empty: none

  bool holds(double value) const { return value >= least && value <= most; }  // not NaN
  /// "a number from 0.01 to 1e+07 (mm/min)", for messages.
  std::string text() const;
};

/// Throws InputError, whose parts are the field, the value with its unit and what is accepted, unless the range holds
/// the value.
void check_range(const std::string& field, double value, const ValueRange& range);

/// The ranges of all quantities that users give, in one place.
namespace ranges {

inline constexpr ValueRange kPitch{1e-6, 1e4, "mm"};   // of pixels, tracks and dwell points: 1 nm to 10 m
inline constexpr ValueRange kLength{0.0, 1e6, "mm"};   // of sizes and distances: to 1 km
inline constexpr ValueRange kSize{1e-6, 1e6, "mm"};    // of what is there: a tool, a lift
inline constexpr ValueRange kPlace{-1e6, 1e6, "mm"};   // of coordinates
inline constexpr ValueRange kHeight{-1e9, 1e9, "nm"};  // to 1 m
inline constexpr ValueRange kRate{1e-9, 1e9, "nm/s"};  // of the fastest removal of a tool: 0.03 nm a year to 1 m/s
inline constexpr ValueRange kDwell{0.0, 1e7, "s"};     // at a dwell point: to four months
inline constexpr ValueRange kTime{1e-9, 1e8, "s"};     // of a run: to three years
inline constexpr ValueRange kFeed{1e-2, 1e7, "mm/min"};
inline constexpr ValueRange kWavelength{100.0, 2e4, "nm"};  // of light that interferes: 0.1 to 20 um
inline constexpr ValueRange kWaveScale{1e-2, 1e2, ""};      // height of a surface for each wave, in wavelengths
inline constexpr ValueRange kFraction{1e-2, 1.0, ""};       // of an error that is to be removed
inline constexpr ValueRange kToolFactor{1e-2, 100.0, ""};   // by which a tool differs from the one that was measured
inline constexpr ValueRange kAngle{-360.0, 360.0, "degrees"};
inline constexpr ValueRange kWeight{0.0, 1e9, ""};
inline constexpr ValueRange kTimePrice{0.0, 1e15, "nm^2/s"};
inline constexpr ValueRange kNumber{-1e16, 1e16, ""};  // of any other

}  // namespace ranges

}  // namespace dwell
