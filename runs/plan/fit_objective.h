#pragma once

#include <optional>
#include <string>

namespace dwell {

/// What the fit makes small: the heights that are left, their slopes, or both. With m pixels, r the heights left, s
/// their slopes and L a length (slope_length), it is
///
///   m / 2 [ (1 - share) mean r^2 + share L^2 (mean s_x^2 + mean s_y^2) ].
struct FitObjective {
  double slope_share = 0.0;        // 0: heights alone, 1: slopes alone
  std::optional<double> length{};  // L [mm]; nothing: the tool's own (slope_length)

  bool has_slopes() const { return slope_share > 0.0; }
  bool operator==(const FitObjective&) const = default;
};

/// Parses "height", "slope" or "mixed:SHARE" with 0 < SHARE < 1, the last two also with ",length=MM". Throws InputError
/// with the value and what is accepted.
FitObjective parse_fit_objective(const std::string& text);
std::string to_string(const FitObjective& objective);

}  // namespace dwell
