#include "runs/programs/frame_text.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/utf8_text.h"
#include "core/base/value_range.h"
#include "runs/programs/number_text.h"

namespace dwell {
namespace {

constexpr double kAnglesPerDegree = 1e9;

/// Takes "NAME=VALUE" from the front of a text, up to a separator or the end; nothing if it is not there.
std::optional<std::string_view> take_value(std::string_view& text, std::string_view name, char separator) {
  if (!text.starts_with(name)) return std::nullopt;
  text.remove_prefix(name.size());
  const std::size_t end = separator == '\0' ? text.size() : text.find(separator);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view value = text.substr(0, end);
  text.remove_prefix(separator == '\0' ? end : end + 1);
  return value;
}

std::optional<double> number_within(const std::optional<std::string_view>& text, const ValueRange& range) {
  const auto value = text ? finite_number(*text) : std::nullopt;
  return value && range.holds(*value) ? value : std::nullopt;
}

}  // namespace

ProgramFrame rounded_frame(Point zero, double degrees, bool swapped) {
  return {{number_of(coordinate_text(zero.x)), number_of(coordinate_text(zero.y))},
          std::round(degrees * kAnglesPerDegree) / kAnglesPerDegree,
          swapped};
}

std::string frame_text(const ProgramFrame& frame) {
  return fmt::format("zero={}/{} rotate={} swap={}", coordinate_text(frame.zero().x), coordinate_text(frame.zero().y),
                     frame.degrees(), frame.swapped() ? "yes" : "no");
}

ProgramFrame parse_frame(std::string_view text) {
  std::string_view rest = text;
  const auto x = number_within(take_value(rest, "zero=", '/'), ranges::kPlace);
  const auto y = number_within(take_value(rest, "", ' '), ranges::kPlace);
  const auto degrees = number_within(take_value(rest, "rotate=", ' '), ranges::kAngle);
  const auto swap = take_value(rest, "swap=", '\0');
  if (!x || !y || !degrees || (swap != "yes" && swap != "no")) {
    throw InputError(fmt::format(
        "\"{}\" does not say how the program lies against the part; required zero=X/Y rotate=DEG swap=yes or no, with "
        "X and Y {} and DEG {}",
        with_escaped_bytes(text), ranges::kPlace.text(), ranges::kAngle.text()));
  }
  return {{*x, *y}, *degrees, swap == "yes"};
}

}  // namespace dwell
