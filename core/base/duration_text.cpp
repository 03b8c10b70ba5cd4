#include "core/base/duration_text.h"

#include <fmt/format.h>

#include <cmath>

namespace dwell {

std::string clock_text(double seconds) {
  constexpr double kMost = 1e15;
  if (!(seconds >= 0.0 && seconds < kMost)) return "";
  constexpr long long kMinute = 60, kHour = 60 * kMinute, kDay = 24 * kHour;
  const long long whole = std::llround(seconds);
  const std::string days = whole >= kDay ? fmt::format("{} d ", whole / kDay) : "";
  return fmt::format("{}{}:{:02}:{:02}", days, whole % kDay / kHour, whole % kHour / kMinute, whole % kMinute);
}

std::string duration_text(double seconds) {
  constexpr double kLeast = 600.0;  // less is read as well in seconds
  const std::string clock = seconds >= kLeast ? clock_text(seconds) : "";
  return fmt::format("{:.2f} s{}", seconds, clock.empty() ? "" : " (" + clock + ")");
}

}  // namespace dwell
