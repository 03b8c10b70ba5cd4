#include "core/formats/said_wavelength.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/base/value_range.h"
#include "core/formats/map_terms.h"

namespace dwell {

bool names_wavelength(std::string_view name) {
  constexpr std::array<std::string_view, 3> kWavelengths{"wavel", "wellenlaenge", "longueurdonde"};
  std::string letters = fold_letters(name);
  std::erase_if(letters, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) == 0; });
  return std::any_of(kWavelengths.begin(), kWavelengths.end(),
                     [&](std::string_view word) { return letters.find(word) != std::string::npos; });
}

bool add_wavelength(double nm, const std::string& shown, MapHeader& header) {
  constexpr double kSameWavelength = 1e-6;  // single precision
  if (!ranges::kWavelength.holds(nm)) return false;
  const bool first = header.wave_field.empty();
  const bool same = header.wavelength && std::abs(*header.wavelength - nm) <= kSameWavelength * nm;
  if (first) header.wavelength = nm;
  if (!first && !same) header.wavelength.reset();
  header.wave_field = shown;
  return true;
}

bool add_wavelength(const HeaderKey& key, std::string_view value, const std::string& place, MapHeader& header) {
  if (!names_wavelength(key.stem)) return false;
  const auto lengths = parse_header_lengths(value);
  if (!lengths || lengths->pixels || lengths->numbers.size() != 1) return false;
  const double unit = lengths->length.value_or(key.length.value_or(0.0));
  return add_wavelength(lengths->numbers.front() * unit, fmt::format("{}, {},", place, key.shown), header);
}

}  // namespace dwell
