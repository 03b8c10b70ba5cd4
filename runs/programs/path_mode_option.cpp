#include "runs/programs/path_mode_option.h"

#include <fmt/format.h>

#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr std::string_view kBlend = "blend", kBlendWithin = "blend:";

}  // namespace

PathModeOption parse_path_mode(const std::string& text) {
  using Choice = PathModeOption::Choice;
  using Kind = PathMode::Kind;
  if (text == "auto") return {};
  if (text == "none") return {Choice::None, {}};
  if (text == "exact-stop") return {Choice::Given, {Kind::ExactStop, {}, {}}};
  if (text == "exact-path") return {Choice::Given, {Kind::ExactPath, {}, {}}};
  if (text == kBlend) return {Choice::Given, {Kind::Blended, {}, {}}};
  if (text.starts_with(kBlendWithin)) {
    const auto tolerance = finite_number(std::string_view(text).substr(kBlendWithin.size()));
    if (tolerance && ranges::kSize.holds(*tolerance)) return {Choice::Given, {Kind::Blended, tolerance, {}}};
  }
  throw InputError(fmt::format("'{}'; accepted: auto, none, exact-stop, exact-path, blend or blend:TOL with TOL {}",
                               text, ranges::kSize.text()));
}

std::string to_string(const PathModeOption& option) {
  if (option.choice == PathModeOption::Choice::Auto) return "auto";
  if (option.choice == PathModeOption::Choice::None) return "none";
  switch (option.mode.kind) {
    case PathMode::Kind::ExactStop:
      return "exact-stop";
    case PathMode::Kind::ExactPath:
      return "exact-path";
    case PathMode::Kind::Blended:
      break;
  }
  return option.mode.tolerance_mm ? fmt::format("{}{}", kBlendWithin, *option.mode.tolerance_mm) : std::string(kBlend);
}

}  // namespace dwell
