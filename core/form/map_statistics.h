#pragma once

#include <optional>
#include <string>

#include "core/form/form_terms.h"
#include "core/map/height_map.h"

namespace dwell {

/// What is left after the form terms are removed [nm].
struct MapStatistics {
  Index valid_pixels = 0;
  double pv = 0.0;    // peak to valley
  double rms = 0.0;   // root mean square about the mean, and so never more than half of the PV
  double mean = 0.0;  // 0 to rounding if piston is removed
  /// PVr, the sibling of the PV that no single pixel decides (core/form/robust_pv.h), of the same pixels; nothing where
  /// it was not computed or there are too few of them.
  std::optional<double> pvr{};

  /// Root mean square about zero: what a solver makes small. The same as `rms` if piston is removed.
  double rms_about_zero() const;
};

/// "RMS 1.473 nm, PV 4.98 nm, PVr 3.11 nm", the last where it is known, and the mean where there is one.
std::string in_words(const MapStatistics& statistics);
/// " about zero" where there is a mean, so that an RMS about zero is another than one about the mean; else nothing.
const char* about_zero_in_words(const MapStatistics& statistics);
/// The same without PV and PVr.
std::string rms_in_words(const MapStatistics& statistics);
/// ", mean 22.48 nm" where there is a mean, else nothing.
std::string mean_in_words(const MapStatistics& statistics);

/// PV, RMS and mean over the finite pixels after removing `terms` by least squares on them. Throws InputError if no
/// pixel is finite. Cost O(pixels).
MapStatistics map_statistics(const HeightMap& map, const FormTerms& terms, int threads = 1);

/// The map with the form terms removed on its finite pixels; NaN stays NaN.
HeightMap without_form(const HeightMap& map, const FormTerms& terms, int threads = 1);

}  // namespace dwell
