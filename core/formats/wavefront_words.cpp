#include "core/formats/wavefront_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/formats/map_terms.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 6> kWavefrontWords{"opd", "opds", "opdmap", "opdmaps", "wfr", "wfe"};
constexpr std::array<std::string_view, 8> kWavefrontPhrases{"wavefront",       "wellenfront",  "frontdonde",
                                                            "opticalpath",     "doublepass",   "doublepath",
                                                            "doppeldurchgang", "doublepassage"};

bool is_latin(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// Whether a word begins at the place: behind what is no letter, "opdMap", "OPDMap".
bool begins_a_word(std::string_view text, std::size_t at) {
  if (at == 0 || !is_latin(text[at - 1])) return true;
  if (!is_capital(text[at])) return false;
  return !is_capital(text[at - 1]) || (at + 1 < text.size() && is_latin(text[at + 1]) && !is_capital(text[at + 1]));
}

}  // namespace

bool names_wavefront(std::string_view text) {
  std::string letters;  // all of them, so that "wave front" and "front d'onde" are one word
  for (const char c : fold_letters(text)) {
    if (is_latin(c)) letters += c;
  }
  const auto in_letters = [&](std::string_view phrase) { return letters.find(phrase) != std::string::npos; };
  if (std::any_of(kWavefrontPhrases.begin(), kWavefrontPhrases.end(), in_letters)) return true;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin + 1;
    while (end < text.size() && is_latin(text[end]) && !begins_a_word(text, end)) ++end;
    const std::string word = fold_letters(text.substr(begin, end - begin));
    if (std::find(kWavefrontWords.begin(), kWavefrontWords.end(), word) != kWavefrontWords.end()) return true;
    begin = end;
  }
  return false;
}

void note_wavefront(std::string_view text, const std::string& place, const std::string& shown, MapHeader& header) {
  if (!names_wavefront(text)) return;
  header.unclear.push_back({UnclearStatement::About::Wavefront,
                            fmt::format("{}: {} speaks of an optical path difference or a wavefront, and a surface is "
                                        "mostly half as high",
                                        place, shown)});
}

const char* way_out_of_wavefront(bool is_map) {
  return is_map ? "; give `wave scale`, the height of the surface for each unit of it: 0.5 for a mirror measured at "
                  "normal incidence, 1 if the values are heights of the surface"
                : "; rates (or heights) of the surface are required, under a name and with remarks that call them so; "
                  "the command tif takes `wave scale` for the maps of spots and trenches";
}

}  // namespace dwell
