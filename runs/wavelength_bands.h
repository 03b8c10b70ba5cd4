#pragma once

#include <string>
#include <vector>

#include "core/psd.h"

namespace dwell {

/// RMS of what a map holds of the wavelengths in a band.
struct BandRms {
  std::string name;       // "form", "mid", "rough"; "1", "2", ... of other than three bands
  double longest = 0.0;   // [mm]; infinity in the first band
  double shortest = 0.0;  // [mm]; 0 in the last
  double rms = 0.0;       // [nm]
  std::string note;       // what of the band the map cannot show; empty if nothing
};

/// Wavelengths between bands [mm], descending, as "33,0.12". Throws InputError naming the text and what is accepted:
/// one to twenty numbers > 0, each less than the one before.
std::vector<double> parse_band_edges(const std::string& text);

/// Bands longer than the first edge, between each two, and shorter than the last. Their squares add up to
/// psd.mean_square: the areal density is integrated, so they are what the window sees.
std::vector<BandRms> band_rms(const ArealPsd& psd, const std::vector<double>& edges);

/// "> 33 mm", "33 - 0.12 mm", "< 0.12 mm".
std::string wavelengths_text(const BandRms& band);

}  // namespace dwell
