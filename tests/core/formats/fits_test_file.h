#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace dwell::test {

/// One image for a FITS file that a test writes by hand from the standard: 64-bit floating point.
struct FitsUnit {
  std::string name;  // EXTNAME, if any
  int cols = 0, rows = 0;
  std::vector<double> values;
  std::vector<std::string> cards;  // more keywords
};

/// Cards of 80 characters in whole blocks of 2880.
inline std::string fits_cards(const std::vector<std::string>& cards) {
  std::string text;
  for (std::string card : cards) {
    card.resize(80, ' ');
    text += card;
  }
  text += "END";
  text.resize((text.size() + 2879) / 2880 * 2880, ' ');
  return text;
}

inline std::string fits_numbers(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) {
    const auto* raw = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof value; i-- > 0;) bytes += raw[i];
  }
  bytes.resize((bytes.size() + 2879) / 2880 * 2880, '\0');
  return bytes;
}

/// The first unit as the primary one; of no columns, it is empty.
inline std::string fits_file(const std::vector<FitsUnit>& units) {
  std::string bytes;
  for (const FitsUnit& unit : units) {
    std::vector<std::string> cards{bytes.empty() ? "SIMPLE  =                    T" : "XTENSION= 'IMAGE   '",
                                   "BITPIX  =                  -64",
                                   fmt::format("NAXIS   = {:20}", unit.cols > 0 ? 2 : 0)};
    if (unit.cols > 0) cards.push_back(fmt::format("NAXIS1  = {:20}", unit.cols));
    if (unit.cols > 0) cards.push_back(fmt::format("NAXIS2  = {:20}", unit.rows));
    if (!bytes.empty()) cards.insert(cards.end(), {"PCOUNT  =                    0", "GCOUNT  =                    1"});
    if (!unit.name.empty()) cards.push_back(fmt::format("EXTNAME = '{}'", unit.name));
    cards.insert(cards.end(), unit.cards.begin(), unit.cards.end());
    bytes += fits_cards(cards) + (unit.cols > 0 ? fits_numbers(unit.values) : "");
  }
  return bytes;
}

}  // namespace dwell::test
