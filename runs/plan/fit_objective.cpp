#include "runs/plan/fit_objective.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {

namespace {

/// The share of slopes; nothing for another text.
std::optional<double> share_of(std::string_view text) {
  if (text == "height") return 0.0;
  if (text == "slope") return 1.0;
  constexpr std::string_view kMixed = "mixed:";
  if (!text.starts_with(kMixed)) return std::nullopt;
  const auto share = parse_number(text.substr(kMixed.size()));
  return share && *share > 0.0 && *share < 1.0 ? share : std::nullopt;
}

}  // namespace

FitObjective parse_fit_objective(const std::string& text) {
  constexpr std::string_view kLength = ",length=";
  constexpr ValueRange kLengths{1e-6, 1e6, "mm"};
  const std::size_t comma = text.find(kLength);
  const auto share = share_of(std::string_view(text).substr(0, comma));
  if (share && comma == std::string::npos) return {*share, std::nullopt};
  if (share && *share > 0.0) {
    const auto length = parse_number(std::string_view(text).substr(comma + kLength.size()));
    if (length && kLengths.holds(*length)) return {*share, length};
  }
  throw InputError(
      fmt::format("'{}'; required height, slope or mixed:SHARE with a share of slopes between 0 and 1, as "
                  "mixed:0.5; of slopes also with the length that makes them heights, slope,length=2 (mm, {})",
                  text, kLengths.text()));
}

std::string to_string(const FitObjective& objective) {
  if (!(objective.slope_share > 0.0)) return "height";
  const std::string length = objective.length ? fmt::format(",length={}", *objective.length) : "";
  return (objective.slope_share < 1.0 ? fmt::format("mixed:{}", objective.slope_share) : "slope") + length;
}

}  // namespace dwell
