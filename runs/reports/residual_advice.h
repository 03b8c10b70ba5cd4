#pragma once

#include <optional>
#include <string>

#include "core/anatomy/residual_anatomy.h"

namespace dwell {

/// What else is known of a plan, by which it is judged what would help. Costs are shares of the mean square that the
/// fit left, blemishes that were left out of it aside.
struct AdviceFacts {
  std::optional<double> price_cost{};       // against a run with next to no price
  std::optional<double> smoothness_cost{};  // against that run without smoothness
  std::optional<double> overrun{};          // of the path beyond the part, on the side where it is least [mm]
  double fraction = 1.0;                    // of the error that was to be removed
  bool blemishes_left_out = false;          // of the fit
};

/// What would lower the mean square that is left by this share is worth a word; below, the tool is at its end.
inline constexpr double kWorthAWord = 0.1;

/// One sentence on what would help most: mask the blemishes, overrun, less smoothness, a longer run, a finer path, or a
/// smaller tool. The rules are in docs/math.md, "What would help".
std::string residual_advice(const ResidualAnatomy& anatomy, const AdviceFacts& facts);

}  // namespace dwell
