#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/spectra/psd.h"

namespace dwell {

/// The RMS of a map in a band of wavelengths.
struct BandRms {
  std::string name;           // "form", "mid", "rough"; "1", "2", ... of other than three bands
  double longest = 0.0;       // [mm]; infinity in the first band
  double shortest = 0.0;      // [mm]; 0 in the last
  std::optional<double> rms;  // [nm]; none for a band that the map does not resolve: its spectrum there is leakage
  std::string note;           // which part of the band the map cannot show; empty if none
};

/// The RMS of a map by wavelength: the squares of all bands that have a value, of `longer` and of `shorter` add up to
/// psd.mean_square.
struct BandSplit {
  std::vector<BandRms> bands;
  double longer = 0.0;   // of wavelengths longer than the part, in no band: form taken out, mean and leakage [nm]
  double shorter = 0.0;  // of bands shorter than two pixels: waves along the diagonal of the pixels [nm]
};

/// Wavelengths between bands [mm], descending, as "33,0.12". Throws InputError naming the text and what is accepted:
/// one to twenty numbers > 0, each less than the one before.
std::vector<double> parse_band_edges(const std::string& text);

/// The bands longer than the first edge, between each two, and shorter than the last; none reaches beyond the length of
/// the part. The areal density is integrated, so these are RMS values under the window.
BandSplit band_rms(const ArealPsd& psd, const std::vector<double>& edges);

/// "> 33 mm", "33 - 0.12 mm", "< 0.12 mm".
std::string wavelengths_text(const BandRms& band);

}  // namespace dwell
