#include "core/formats/field_texts.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/map/value_units.h"

namespace dwell {

std::string unit_of_label(const std::string& label) {
  const std::string_view text = trim(label);
  for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}}) {
    if (!text.ends_with(close)) continue;
    const std::size_t at = text.rfind(open);
    if (at == std::string_view::npos) return "";
    const std::string unit(trim(text.substr(at + 1, text.size() - at - 2)));
    return known_value_unit(unit) || is_wave_unit(unit) ? unit : "";
  }
  return "";
}

std::optional<double> length_of_text(const std::string& text) {
  const std::string_view all = trim(text);
  const std::size_t at = all.find_last_of("0123456789.");
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = finite_number(all.substr(0, at + 1));
  const auto nm = known_length_unit(all.substr(at + 1));
  return number && nm ? std::optional(*number * *nm / units::kNmPerMm) : std::nullopt;
}

bool is_same_unit(const std::string& a, const std::string& b) {
  return a == b || (is_wave_unit(a) && is_wave_unit(b)) ||
         (known_length_unit(a) && known_length_unit(a) == known_length_unit(b)) ||
         (known_rate_unit(a) && known_rate_unit(a) == known_rate_unit(b));
}

bool is_unit_of_no_height(const std::string& text) {
  constexpr std::string_view kNoHeights[] = {"s",  "sec", "ms",   "us",  "hz",      "khz",    "mhz",   "ghz",
                                             "k",  "c",   "v",    "mv",  "a",       "ma",     "w",     "mw",
                                             "kg", "g",   "n",    "pa",  "deg",     "degree", "rpm",   "%",
                                             "px", "adu", "mbar", "bar", "percent", "pixels", "pixel", "counts"};
  return is_among(lower_case(trim(text)), kNoHeights);
}

bool speaks_of_a_place(const std::string& text) {
  if (length_of_text(text) || finite_number(text)) return true;
  const std::string lower = lower_case(text);
  constexpr std::string_view kWords[] = {"upper", "lower", "top", "bottom", "left", "right", "centre", "center"};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool names_another_corner(const std::string& text) {
  const std::string lower = lower_case(text);
  return lower.find("upper") != std::string::npos || lower.find("top") != std::string::npos ||
         lower.find("right") != std::string::npos;
}

}  // namespace dwell
