#include "core/formats/remark_values.h"

#include <string>

#include "core/base/number_text.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 14> kWaves{"waves",  "wave",   "wv",       "fringe",  "fringes",
                                                  "lambda", "rad",    "radian",   "radians", "mrad",
                                                  "urad",   "counts", "\xce\xbb", "count"};

/// "nm RMS 3.4": the unit of a figure behind it.
bool is_of_a_figure(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kFigures{"rms", "pv", "p-v", "ptv", "ra", "rq", "sa", "sq"};
  return at + 2 < words.size() && is_among(words[at + 1].folded, kFigures) && words[at + 2].number &&
         !(words[at].bracketed() || (at > 0 && words[at - 1].folded == "in"));
}

}  // namespace

bool speaks_of_a_unit(const Remark& words, std::size_t at) {
  if (is_of_a_figure(words, at)) return false;
  return unit_of_word(words, at) && !follows_a_number(words, at) && !names_a_number(words, at) &&
         !is_of_another_quantity(words, at);
}

bool speaks_of_waves(const Remark& words, std::size_t at) {
  if (!is_among(words[at].folded, kWaves) || follows_a_number(words, at) || is_of_another_quantity(words, at))
    return false;
  if (names_a_number(words, at)) return false;
  constexpr std::array<std::string_view, 5> kAlsoProse{"wave", "fringe", "count", "counts", "fringes"};
  if (is_among(words[at].folded, kAlsoProse)) return is_announced(words, at) && words[at].before != ',';
  return is_announced(words, at) || holds_value_word(words, clause_of(words, at), at);
}

}  // namespace dwell
