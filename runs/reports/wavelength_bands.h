#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/spectra/psd.h"

namespace dwell {

/// RMS of what a map holds of the wavelengths in a band.
struct BandRms {
  std::string name;           // "form", "mid", "rough"; "1", "2", ... of other than three bands
  double longest = 0.0;       // [mm]; infinity in the first band
  double shortest = 0.0;      // [mm]; 0 in the last
  std::optional<double> rms;  // [nm]; none of a band that the map does not resolve: what lies there is leakage
  std::string note;           // what of the band the map cannot show; empty if nothing
};

/// What a map holds, by wavelength: the squares of all bands that have a value, of `longer` and of `shorter` add up to
/// psd.mean_square.
struct BandSplit {
  std::vector<BandRms> bands;
  double longer = 0.0;   // of wavelengths longer than the part, in no band: form taken out, mean and leakage [nm]
  double shorter = 0.0;  // of bands shorter than two pixels: waves along the diagonal of the pixels [nm]
};

/// Wavelengths between bands [mm], descending, as "33,0.12". Throws InputError naming the text and what is accepted:
/// one to twenty numbers > 0, each less than the one before.
std::vector<double> parse_band_edges(const std::string& text);

/// Bands longer than the first edge, between each two, and shorter than the last, as far as the part is long. The areal
/// density is integrated, so they are what the window sees.
BandSplit band_rms(const ArealPsd& psd, const std::vector<double>& edges);

/// "> 33 mm", "33 - 0.12 mm", "< 0.12 mm".
std::string wavelengths_text(const BandRms& band);

}  // namespace dwell
