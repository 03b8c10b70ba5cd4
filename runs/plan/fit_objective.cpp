#include "runs/plan/fit_objective.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {

FitObjective parse_fit_objective(const std::string& text) {
  if (text == "height") return {0.0};
  if (text == "slope") return {1.0};
  constexpr std::string_view kMixed = "mixed:";
  if (text.starts_with(kMixed)) {
    const auto share = parse_number(text.substr(kMixed.size()));
    if (share && *share > 0.0 && *share < 1.0) return {*share};
  }
  throw InputError(
      fmt::format("'{}'; required height, slope or mixed:SHARE with a share of slopes between 0 and 1, as "
                  "mixed:0.5",
                  text));
}

std::string to_string(const FitObjective& objective) {
  if (!(objective.slope_share > 0.0)) return "height";
  if (!(objective.slope_share < 1.0)) return "slope";
  return fmt::format("mixed:{}", objective.slope_share);
}

}  // namespace dwell
