#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"
#include "paths/lines/turnarounds.h"

namespace dwell {

struct RandomRasterOptions {
  double pitch = 0.0;             // mean distance between neighbouring lines [mm], finite and > 0; required
  double spread = 0.3;            // line distances lie within pitch * (1 -/+ spread): >= 0, < 1
  std::optional<double> step;     // distance between dwell points of a line [mm], finite and > 0; default = pitch
  double angle_deg = 0.0;         // direction of the lines, counter-clockwise from +x; finite
  std::optional<double> overrun;  // how far lines go on beyond the valid pixels [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
  bool serpentine = true;         // every other line backwards; false = one-way, each line entered lifted
  TurnOptions turns;              // how lines are joined, and whether corners are rounded
  std::uint64_t seed = 1;         // of the distances
};

/// From "random-raster:pitch=MM,..."; spread may be written in mm ("spread=0.2") or as a share of the pitch
/// ("spread=20%"). Throws InputError as SpecText does.
RandomRasterOptions parse_random_raster_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> random_raster_distances(const RandomRasterOptions& options);

/// A raster (raster.h) whose line distances vary at random, against the ripple that equal distances leave ("path
/// interval changing", Zha et al. 2020, sections 3.2 and 4.2, where the pitch is that of the best overlap).
///
/// Distances are drawn one by one, uniformly from pitch (1 - spread) to pitch (1 + spread). There are as many lines as
/// fit into the box of the valid pixel centres widened by the overrun, and their block lies in the middle of it. Every
/// valid pixel is within half of the largest distance, pitch (1 + spread) / 2, of a line, whatever the overrun. Dwell
/// points lie on lines as the raster's do. The same seed gives the same path on every machine (mt19937_64); the
/// distances drawn do not depend on the map.
///
/// Throws InputError naming the option, its value and what is required; also above 50 million points. Cost O(pixels +
/// lattice points).
ToolPath random_raster_path(const HeightMap& map, const RandomRasterOptions& options, const Progress& progress = {});

}  // namespace dwell
