#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

struct PictureOptions {
  std::string title;            // above the figure; broken into lines where too long
  std::string unit;             // of the values, beside the colour bar: "nm", "nm/s"
  bool diverging = false;       // true: blue - white - red about zero; false: viridis
  std::optional<double> lower;  // colour limits, in the unit of the values; defaults: colour_limits in
  std::optional<double> upper;  // runs/drawing/colour_map.h
  /// The map whose range the colours have where no limit is given, as of the pixels that count; null: that which is
  /// drawn.
  const HeightMap* range = nullptr;
};

/// A figure of a map: +x right, +y up, true to the pitches, axes in mm, colour bar. NaN is light grey; a map without
/// any finite pixel says "no data". Throws InputError for colour limits that are out of order or not finite,
/// Interrupted. Cost O(pixels); about 0.3 s for 4096 x 4096 of them.
std::string map_picture(const HeightMap& map, const PictureOptions& options, FigureFormat format = FigureFormat::Png,
                        const Progress& progress = {});

/// A figure of a later map of the same surface: once in colours over the range of an earlier map, so that the two
/// figures can be compared, and once over its own range, because after a good correction the map is almost white on the
/// earlier range. Diverging colours; FigureRange::Own draws the second alone. `own`: the map whose range is the own
/// one; null: `after`. As map_picture in all else.
std::string after_picture(const HeightMap& before, const HeightMap& after, FigureRange range, const std::string& title,
                          FigureFormat format = FigureFormat::Png, const Progress& progress = {},
                          const HeightMap* own = nullptr);

/// A figure of the dwell times [s] of a path, each point a square at its place (field_of_dwell in
/// runs/drawing/plot_field.h); lifted moves are not drawn. The unit is s unless options say otherwise. Throws
/// InputError if the path is invalid, dwell has another size, or for colour limits that are out of order or not finite;
/// Interrupted. Cost O(points); about 0.5 s for 10^6.
std::string dwell_picture(const ToolPath& path, const std::vector<double>& dwell, const PictureOptions& options,
                          FigureFormat format = FigureFormat::Png, const Progress& progress = {});

}  // namespace dwell
