#pragma once

#include <fmt/format.h>

#include <string>

namespace dwell {

/// A share of at most one in per cent with two digits, three where two would make it a power of ten: "28", "99.6",
/// "100".
inline std::string percent_text(double share) {
  const double percent = 100.0 * share;
  return percent < 99.5 ? fmt::format("{:.2g}", percent) : fmt::format("{:.3g}", percent);
}

}  // namespace dwell
