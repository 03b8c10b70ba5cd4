#pragma once

#include <optional>

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_function.h"
#include "paths/metrics/ripple_spectrum.h"

namespace dwell {

struct PathRippleOptions {
  double depth = 100.0;         // mean removal of the patch [nm], finite and > 0
  std::optional<double> side;   // of the square patch [mm], > 0; default: see path_ripple
  std::optional<double> pixel;  // [mm], > 0, at most half the removal function's FWHM; default: see path_ripple
  std::optional<Point> centre;  // default: the middle of the path's bounding box
  RippleBand band;
  int threads = 1;
};

/// What a path at one feed leaves on a patch of the part.
struct PathRipple {
  HeightMap removal;     // [nm] on the patch's fine grid
  double feed = 0.0;     // that removes `depth` on average [mm/s]
  double spacing = 0.0;  // mean distance between neighbouring lines there: area over length of path within it [mm]
  double pve = 0.0;      // peak to valley [nm]
  double pvn = 0.0;      // pve / depth
  double rms = 0.0;      // about the mean [nm]
  RippleSpectrum spectrum;
};

/// Removal of any path at constant feed, by the moving-tool operator (core/removal/scattered_removal.h) on a fine grid:
/// for spirals, Hilbert curves or random paths it is what raster_ripple is for straight lines. The dwell of a stroke is
/// its length over the feed; halts have none. The removal function is the spline of its samples on the patch's pixels,
/// which blurs a sharp rim: a spinning disc shows about two thirds of its exact PVe at the default pixel, all of its
/// RMS.
///
/// Default side: four sizes (2 radius) of the removal function, at most what the path's bounding box leaves when it is
/// narrowed by the radius on every side (the path's own edge must not reach the patch). Default pixel: an eighth of the
/// spacing, but at most an eighth of the FWHM and at least 1/1024 of the side. If the path does not fill its bounding
/// box evenly, give `centre` and `side`.
///
/// Throws InputError naming an option out of range; also if no room is left for the patch, if it would have more than
/// 4096 pixels a side, or if nothing is removed on part of it (in a hole of the part: give a centre). Cost: O(strokes)
/// and a transform of the patch widened by the removal function; strokes that do not reach the patch are left out.
PathRipple path_ripple(const ToolPath& path, const RemovalFunction& tif, const PathRippleOptions& options,
                       const Progress& progress = {});

}  // namespace dwell
