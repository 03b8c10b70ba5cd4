#pragma once

#include "core/form/form_terms.h"
#include "core/map/height_map.h"

namespace dwell {

struct MapStatistics {
  Index valid_pixels = 0;
  double pv = 0.0;   // peak to valley [nm]
  double rms = 0.0;  // root mean square about zero after the form terms are removed [nm]
};

/// PV and RMS over the finite pixels after removing `terms` by least squares on them. With piston not removed, RMS
/// is about zero, not about the mean. Throws InputError if no pixel is finite. Cost O(pixels).
MapStatistics map_statistics(const HeightMap& map, const FormTerms& terms, int threads = 1);

/// The map with the form terms removed on its finite pixels; NaN stays NaN.
HeightMap without_form(const HeightMap& map, const FormTerms& terms, int threads = 1);

}  // namespace dwell
