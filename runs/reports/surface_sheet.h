#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/map/surface_slope.h"
#include "core/spectra/wavelength_bands.h"

namespace dwell {

/// What a surface is like apart from its RMS and PV.
struct SurfaceFigures {
  SlopeStatistics slope;       // [urad]
  std::vector<BandRms> bands;  // under a Hann window, the mean taken out [nm]
  double longer = 0.0;         // of waves longer than the part, in no band [nm]
};

/// The surface before a program and the one that it leaves, form terms removed from both.
struct SurfaceSheet {
  SurfaceFigures before, after;
};

/// The bands are those of a tool of this FWHM [mm] (tool_band_edges). Throws Interrupted. Cost: two FFTs of the map.
SurfaceSheet surface_sheet(const HeightMap& before, const HeightMap& after, double fwhm, int threads,
                           const Progress& progress);

/// The lines of the table: "slope" and one "band" each, before and after.
std::string surface_lines(const SurfaceSheet& sheet);

/// The block "surface" of the JSON (docs/json.md).
nlohmann::ordered_json surface_block(const SurfaceSheet& sheet);

/// Parts of it, as other blocks hold them.
nlohmann::ordered_json slope_json(const SlopeStatistics& slope);
nlohmann::ordered_json bands_json(const std::vector<BandRms>& bands);

}  // namespace dwell
