#include "core/map/value_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"

namespace dwell {
namespace {

struct UnitWord {
  std::string_view word;  // in lower case, words of length in the singular
  double factor;          // to nm, or to s
};

constexpr UnitWord kLengthWords[] = {
    {"nm", 1.0},
    {"nanometer", 1.0},
    {"nanometre", 1.0},
    {"um", units::kNmPerUm},
    {"\xc2\xb5m", units::kNmPerUm},  // the micro sign
    {"\xce\xbcm", units::kNmPerUm},  // the Greek letter
    {"\xb5m", units::kNmPerUm},      // the micro sign in Latin-1
    {"micron", units::kNmPerUm},
    {"micrometer", units::kNmPerUm},
    {"micrometre", units::kNmPerUm},
    {"mikrometer", units::kNmPerUm},
    {"microm\xc3\xa8tre", units::kNmPerUm},
    {"nanom\xc3\xa8tre", 1.0},
    {"mm", units::kNmPerMm},
    {"millimeter", units::kNmPerMm},
    {"millimetre", units::kNmPerMm},
    {"millim\xc3\xa8tre", units::kNmPerMm},
    {"cm", 10.0 * units::kNmPerMm},
    {"centimeter", 10.0 * units::kNmPerMm},
    {"centimetre", 10.0 * units::kNmPerMm},
    {"zentimeter", 10.0 * units::kNmPerMm},
    {"centim\xc3\xa8tre", 10.0 * units::kNmPerMm},
    {"m", units::kNmPerM},
    {"m\xc3\xa8tre", units::kNmPerM},
    {"meter", units::kNmPerM},
    {"metre", units::kNmPerM},
    {"pm", 1e-3},
    {"picometer", 1e-3},
    {"picometre", 1e-3},
    {"angstrom", 0.1},
    {"\xc3\x85", 0.1},      // the letter A with a ring
    {"\xc3\xa5", 0.1},      // the same in lower case
    {"\xe2\x84\xab", 0.1},  // the angstrom sign
    {"in", 25.4 * units::kNmPerMm},
    {"inch", 25.4 * units::kNmPerMm},
    {"inches", 25.4 * units::kNmPerMm},
    {"zoll", 25.4 * units::kNmPerMm},
    {"pouce", 25.4 * units::kNmPerMm},
    {"micra", units::kNmPerUm},  // Spanish and Italian, here and below
    {"micrometro", units::kNmPerUm},
    {"micr\xc3\xb3"
     "metro",
     units::kNmPerUm},
    {"micrometri", units::kNmPerUm},
    {"mikron", units::kNmPerUm},
    {"nanometro", 1.0},
    {"nan\xc3\xb3"
     "metro",
     1.0},
    {"nanometri", 1.0},
    {"milimetro", units::kNmPerMm},
    {"mil\xc3\xad"
     "metro",
     units::kNmPerMm},
    {"millimetro", units::kNmPerMm},
    {"millimetri", units::kNmPerMm},
    {"metro", units::kNmPerM},
    {"metri", units::kNmPerM},
    {"\xd0\xbd\xd0\xbc", 1.0},  // Russian, here and below
    {"\xd0\xbd\xd0\xb0\xd0\xbd\xd0\xbe\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80", 1.0},
    {"\xd0\xbd\xd0\xb0\xd0\xbd\xd0\xbe\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80\xd1\x8b", 1.0},
    {"\xd0\xbc\xd0\xba\xd0\xbc", units::kNmPerUm},
    {"\xd0\xbc\xd0\xb8\xd0\xba\xd1\x80\xd0\xbe\xd0\xbd", units::kNmPerUm},
    {"\xd0\xbc\xd0\xb8\xd0\xba\xd1\x80\xd0\xbe\xd0\xbd\xd1\x8b", units::kNmPerUm},
    {"\xd0\xbc\xd0\xb8\xd0\xba\xd1\x80\xd0\xbe\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80", units::kNmPerUm},
    {"\xd0\xbc\xd0\xb8\xd0\xba\xd1\x80\xd0\xbe\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80\xd1\x8b", units::kNmPerUm},
    {"\xd0\xbc\xd0\xbc", units::kNmPerMm},
    {"\xd0\xbc\xd0\xb8\xd0\xbb\xd0\xbb\xd0\xb8\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80", units::kNmPerMm},
    {"\xd0\xbc\xd0\xb8\xd0\xbb\xd0\xbb\xd0\xb8\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80\xd1\x8b", units::kNmPerMm},
    {"\xd0\xbc", units::kNmPerM},
    {"\xd0\xbc\xd0\xb5\xd1\x82\xd1\x80", units::kNmPerM},
    {"\xe7\xba\xb3\xe7\xb1\xb3", 1.0},  // Chinese, Japanese and Korean, here and below
    {"\xe7\xb4\x8d\xe7\xb1\xb3", 1.0},
    {"\xe5\xa5\x88\xe7\xb1\xb3", 1.0},
    {"\xe3\x83\x8a\xe3\x83\x8e\xe3\x83\xa1\xe3\x83\xbc\xe3\x83\x88\xe3\x83\xab", 1.0},
    {"\xeb\x82\x98\xeb\x85\xb8\xeb\xaf\xb8\xed\x84\xb0", 1.0},
    {"\xe5\xbe\xae\xe7\xb1\xb3", units::kNmPerUm},
    {"\xe3\x83\x9e\xe3\x82\xa4\xe3\x82\xaf\xe3\x83\xad\xe3\x83\xa1\xe3\x83\xbc\xe3\x83\x88\xe3\x83\xab",
     units::kNmPerUm},
    {"\xe3\x83\x9f\xe3\x82\xaf\xe3\x83\xad\xe3\x83\xb3", units::kNmPerUm},
    {"\xeb\xa7\x88\xec\x9d\xb4\xed\x81\xac\xeb\xa1\x9c\xeb\xaf\xb8\xed\x84\xb0", units::kNmPerUm},
    {"\xe6\xaf\xab\xe7\xb1\xb3", units::kNmPerMm},
    {"\xe3\x83\x9f\xe3\x83\xaa\xe3\x83\xa1\xe3\x83\xbc\xe3\x83\x88\xe3\x83\xab", units::kNmPerMm},
    {"\xeb\xb0\x80\xeb\xa6\xac\xeb\xaf\xb8\xed\x84\xb0", units::kNmPerMm},
    {"\xe7\xb1\xb3", units::kNmPerM},
    {"\xe3\x83\xa1\xe3\x83\xbc\xe3\x83\x88\xe3\x83\xab", units::kNmPerM},
};

constexpr UnitWord kTimeWords[] = {{"s", 1.0},
                                   {"sec", 1.0},
                                   {"second", 1.0},
                                   {"min", units::kSecondsPerMinute},
                                   {"minute", units::kSecondsPerMinute},
                                   {"h", 60.0 * units::kSecondsPerMinute},
                                   {"hr", 60.0 * units::kSecondsPerMinute},
                                   {"hour", 60.0 * units::kSecondsPerMinute},
                                   {"\xd1\x81", 1.0},
                                   {"\xd1\x81\xd0\xb5\xd0\xba", 1.0},
                                   {"\xd0\xbc\xd0\xb8\xd0\xbd", units::kSecondsPerMinute},
                                   {"\xe7\xa7\x92", 1.0}};

constexpr const char* kAcceptedHeights = "nm, um, mm, m";
constexpr const char* kAcceptedRates = "nm/s, um/s, um/min, m/s";

/// Without blanks, brackets and quotes around it.
std::string_view bare(std::string_view text) {
  for (text = trim(text); text.size() >= 2; text = trim(text.substr(1, text.size() - 2))) {
    constexpr std::array<std::array<char, 2>, 4> kPairs = {{{'(', ')'}, {'[', ']'}, {'"', '"'}, {'\'', '\''}}};
    const auto encloses = [&](std::array<char, 2> pair) { return text.front() == pair[0] && text.back() == pair[1]; };
    if (std::none_of(kPairs.begin(), kPairs.end(), encloses)) break;
  }
  return text;
}

/// The factor of a word, which may be in the plural ("microns").
std::optional<double> find_factor(std::string_view word, std::span<const UnitWord> known) {
  const auto factor_of_word = [&](std::string_view wanted) -> std::optional<double> {
    const auto* const end = std::to_address(known.end());
    const auto* const found =
        std::find_if(known.data(), end, [&](const UnitWord& unit) { return unit.word == wanted; });
    return found == end ? std::nullopt : std::optional(found->factor);
  };
  if (const auto factor = factor_of_word(word)) return factor;
  const bool plural = word.size() > 4 && word.ends_with('s');
  return plural ? factor_of_word(word.substr(0, word.size() - 1)) : std::nullopt;
}

/// Cuts "-1", "^-1", "**-1" or "^(-1)" off the end; false if there is none.
bool cut_inverse(std::string_view& text) {
  for (const std::string_view ending : {"^(-1)", "**-1", "^-1", "-1"}) {
    if (!text.ends_with(ending)) continue;
    text.remove_suffix(ending.size());
    return true;
  }
  return false;
}

/// "um/min" -> "um" and "min"; nothing of a text that is no quotient.
std::optional<std::array<std::string_view, 2>> split_quotient(std::string_view text) {
  for (const std::string_view sign : {"/", " per "}) {
    const std::size_t at = text.find(sign);
    if (at != std::string_view::npos) return std::array{text.substr(0, at), text.substr(at + sign.size())};
  }
  if (!cut_inverse(text)) return std::nullopt;
  const std::size_t at = text.find_last_of(" *.");
  if (at == std::string_view::npos) return std::nullopt;
  return std::array{text.substr(0, at), text.substr(at + 1)};
}

/// "micrometre (um)" and "um [micrometre]" -> the two names; nothing of a text that is not of that kind.
std::optional<std::array<std::string_view, 2>> split_two_names(std::string_view text) {
  text = trim(text);
  if (text.empty() || (text.back() != ')' && text.back() != ']')) return std::nullopt;
  const std::size_t open = text.find(text.back() == ')' ? '(' : '[');
  if (open == std::string_view::npos || open == 0) return std::nullopt;
  return std::array{trim(text.substr(0, open)), text.substr(open)};
}

/// The factor of a unit that is named twice, if both names are of one unit.
std::optional<double> find_twice(std::string_view text, std::optional<double> (&known)(std::string_view)) {
  const auto names = split_two_names(text);
  if (!names) return std::nullopt;
  const auto first = known((*names)[0]);
  return first && first == known((*names)[1]) ? first : std::nullopt;
}

}  // namespace

std::optional<double> known_length_unit(std::string_view text) {
  if (const auto factor = find_factor(lower_case(bare(text)), kLengthWords)) return factor;
  return find_twice(text, known_length_unit);
}

std::optional<double> known_rate_unit(std::string_view text) {
  if (const auto twice = find_twice(text, known_rate_unit)) return twice;
  const std::string lower = lower_case(bare(text));
  const auto parts = split_quotient(lower);
  if (!parts) return std::nullopt;
  const std::optional<double> length = known_length_unit((*parts)[0]),
                              time = find_factor(trim((*parts)[1]), kTimeWords);
  return length && time ? std::optional(*length / *time) : std::nullopt;
}

std::optional<double> known_value_unit(std::string_view text) {
  const std::optional<double> length = known_length_unit(text);
  return length ? length : known_rate_unit(text);
}

bool is_wave_unit(std::string_view text) {
  constexpr std::array<std::string_view, 26> kWaves{"wave",
                                                    "waves",
                                                    "wv",
                                                    "wvs",
                                                    "lambda",
                                                    "lambdas",
                                                    "\xce\xbb",
                                                    "wavelength",
                                                    "wavelengths",
                                                    "fringe",
                                                    "fringes",
                                                    "welle",
                                                    "wellen",
                                                    "streifen",
                                                    "wellenl\xc3\xa4nge",
                                                    "wellenl\xc3\xa4ngen",
                                                    "wellenlaenge",
                                                    "wellenlaengen",
                                                    "onde",
                                                    "ondes",
                                                    "frange",
                                                    "franges",
                                                    "longueur d'onde",
                                                    "longueurs d'onde",
                                                    "interferenzstreifen",
                                                    "longueurs d'ondes"};
  return std::find(kWaves.begin(), kWaves.end(), lower_case(bare(text))) != kWaves.end();
}

double height_unit_nm(const std::string& unit) {
  if (const auto factor = known_length_unit(unit)) return *factor;
  throw InputError(fmt::format("'{}'{}; accepted: {}", unit, known_rate_unit(unit) ? " is a rate, not a height" : "",
                               kAcceptedHeights));
}

double rate_unit_nm_per_s(const std::string& unit) {
  if (const auto factor = known_rate_unit(unit)) return *factor;
  throw InputError(fmt::format("'{}'{}; accepted: {}", unit, known_length_unit(unit) ? " is a height, not a rate" : "",
                               kAcceptedRates));
}

double unit_factor(const std::string& unit, MapQuantity quantity) {
  return quantity == MapQuantity::Rate ? rate_unit_nm_per_s(unit) : height_unit_nm(unit);
}

std::string unit_of(MapQuantity quantity) { return quantity == MapQuantity::Rate ? "nm/s" : "nm"; }

}  // namespace dwell
