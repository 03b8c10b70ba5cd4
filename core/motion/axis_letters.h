#pragma once

#include <string_view>

namespace dwell {

/// What a controller calls the axes of the part's plane.
struct AxisLetters {
  char x = 'X', y = 'Y';

  bool operator==(const AxisLetters&) const = default;
};

/// Those that an axis of the plane may have. Z is the height of the tool.
inline constexpr std::string_view kAxisLetters = "XYUVWABC";

}  // namespace dwell
