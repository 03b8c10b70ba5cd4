#include "core/spectra/wavelength_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

std::string note_of(const ArealPsd& psd, const BandRms& band) {
  const double longest = psd.longest_wavelength(), shortest = psd.shortest_wavelength();
  if (band.shortest >= longest) return fmt::format("not resolved: the part is {:.4g} mm long", longest);
  if (band.longest <= shortest) return fmt::format("not resolved: two pixels are {:.4g} mm", shortest);
  std::string note;
  if (std::isfinite(band.longest) && band.longest > longest)
    note = fmt::format("only up to the {:.4g} mm of the part", longest);
  if (band.shortest < shortest) {
    note += fmt::format("{}only down to two pixels, {:.4g} mm", note.empty() ? "" : ", ", shortest);
  }
  return note;
}

}  // namespace

std::vector<double> parse_band_edges(const std::string& text) {
  std::vector<double> edges;
  bool good = true;
  for (const std::string_view field : split(text, ',')) {
    const auto edge = finite_number(field);
    good = good && edge && ranges::kSize.holds(*edge) && (edges.empty() || *edge < edges.back());
    if (good) edges.push_back(*edge);
  }
  if (good && edges.size() <= 20) return edges;
  throw InputError(
      fmt::format("bands \"{}\"; accepted: wavelengths in mm, descending, at most 20, for instance 33,0.12, each {}",
                  text, ranges::kSize.text()));
}

BandSplit band_rms(const ArealPsd& psd, const std::vector<double>& edges) {
  static const std::array<const char*, 3> kNames{"form", "mid", "rough"};
  std::vector<double> frequencies;
  frequencies.reserve(edges.size() + 1);
  for (const double edge : edges) frequencies.push_back(1.0 / edge);
  // The frequency of one wave on the part, where the bands end; the margin keeps the sample there in the bands, however
  // it is rounded.
  const double lowest = (1.0 - 1e-9) / psd.longest_wavelength();
  const auto cut = std::upper_bound(frequencies.begin(), frequencies.end(), lowest);
  const auto longer = static_cast<std::size_t>(cut - frequencies.begin());
  frequencies.insert(cut, lowest);
  const std::vector<double> squares = band_mean_squares(psd, frequencies);
  BandSplit split;
  double below = 0.0, above = 0.0;
  for (std::size_t k = 0; k <= longer; ++k) below += squares[k];
  for (std::size_t k = 0; k <= edges.size(); ++k) {
    BandRms band;
    band.name = edges.size() + 1 == kNames.size() ? kNames[k] : fmt::format("{}", k + 1);
    band.longest = k == 0 ? std::numeric_limits<double>::infinity() : edges[k - 1];
    band.shortest = k == edges.size() ? 0.0 : edges[k];
    band.note = note_of(psd, band);
    const double square = k < longer ? 0.0 : squares[k + 1];
    if (band.shortest < psd.longest_wavelength() && band.longest > psd.shortest_wavelength()) {
      band.rms = std::sqrt(square);
    } else {
      above += square;
    }
    split.bands.push_back(band);
  }
  split.longer = std::sqrt(below);
  split.shorter = std::sqrt(above);
  return split;
}

std::string wavelengths_text(const BandRms& band) {
  if (!std::isfinite(band.longest)) return band.shortest > 0.0 ? fmt::format("> {:.4g} mm", band.shortest) : "all";
  if (band.shortest == 0.0) return fmt::format("< {:.4g} mm", band.longest);
  return fmt::format("{:.4g} - {:.4g} mm", band.longest, band.shortest);
}

}  // namespace dwell
