#include "runs/job/place_option.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "core/formats/header_words.h"

namespace dwell {

Point parse_point(const std::string& text) {
  const auto fields = split(text, ',');
  if (fields.size() == 2) {
    const auto x = finite_number(fields[0]), y = finite_number(fields[1]);
    if (x && y && ranges::kPlace.holds(*x) && ranges::kPlace.holds(*y)) return {*x, *y};
  }
  throw InputError(fmt::format("'{}'; required X,Y in mm, for instance -12.5,3, each {}", text, ranges::kPlace.text()));
}

Point parse_pitch(const std::string& text) {
  const auto fields = split(text, ',');
  if (fields.size() == 2 && may_have_decimal_comma(text)) {
    throw InputError(fmt::format(
        "'{0}': a decimal comma, or x and y? Write {1}.{2} mm so, with a point, or two pitches as {1}.0,{2}.0", text,
        trim(fields[0]), trim(fields[1])));
  }
  if (fields.size() <= 2) {
    const auto x = finite_number(fields.front()), y = finite_number(fields.back());
    if (x && y && ranges::kPitch.holds(*x) && ranges::kPitch.holds(*y)) return {*x, *y};
  }
  throw InputError(fmt::format("'{}'; required {}, or two of them, X,Y, for pixels that are not square", text,
                               ranges::kPitch.text()));
}

std::string to_string(const Point& point) { return fmt::format("{},{}", point.x, point.y); }

std::optional<TifCentre> parse_tif_centre(const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (text == "middle") return TifCentre{TifCentre::Kind::Middle, {}};
  if (text == "centroid") return TifCentre{TifCentre::Kind::Centroid, {}};
  if (text == "peak") return TifCentre{TifCentre::Kind::Peak, {}};
  try {
    return TifCentre{TifCentre::Kind::Given, parse_point(text)};
  } catch (const InputError&) {
    throw InputError(fmt::format("'{}'; accepted: auto, middle, centroid, peak, or X,Y in mm", text));
  }
}

std::string to_string(const std::optional<TifCentre>& centre) {
  if (!centre) return "auto";
  switch (centre->kind) {
    case TifCentre::Kind::Middle:
      return "middle";
    case TifCentre::Kind::Centroid:
      return "centroid";
    case TifCentre::Kind::Peak:
      return "peak";
    default:
      return to_string(centre->given);
  }
}

}  // namespace dwell
