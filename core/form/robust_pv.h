#pragma once

#include <optional>

#include "core/form/map_statistics.h"
#include "core/map/height_map.h"

namespace dwell {

struct RobustPv {
  double pvr = 0.0;           // fit_pv + 3 residual_rms [nm]
  double fit_pv = 0.0;        // of the 36-term fit on the valid pixels
  double residual_rms = 0.0;  // of what it leaves
};

/// PVr, a peak-to-valley value that no single pixel decides: the PV of the fit of the first 36 Fringe Zernike
/// polynomials plus three times the RMS of what they leave (C. J. Evans 2009, "PVr: a robust amplitude parameter for
/// optical surface specification", Opt. Eng. 48, 043605). On parts that are not round, the polynomials are those of the
/// smallest circle about the middle of the bounding box that holds the part. Nothing if there are fewer finite pixels
/// than terms: the fit would then pass through every one of them. Throws InputError if no pixel is finite.
std::optional<RobustPv> robust_pv(const HeightMap& map, int threads = 1);

/// The statistics of the map, with its PVr.
MapStatistics with_robust_pv(MapStatistics statistics, const HeightMap& map, int threads = 1);

}  // namespace dwell
