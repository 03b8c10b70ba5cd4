#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

struct PictureOptions {
  std::string title;            // above the picture; broken into lines where too long. ASCII
  std::string unit;             // of the values, beside the colour bar: "nm", "nm/s"
  bool diverging = false;       // true: blue - white - red about zero; false: viridis
  std::optional<double> lower;  // colour limits, in the unit of the values; defaults: colour_limits in
  std::optional<double> upper;  // runs/drawing/colour_map.h
};

/// A PNG file of a map: +x right, +y up, true to the pitches, axes in mm, colour bar. NaN is light grey; a map without
/// any finite pixel says "no data". Throws InputError for colour limits that are none. Cost O(pixels).
std::string map_picture(const HeightMap& map, const PictureOptions& options);

/// A PNG file of the dwell times [s] of a path, each point a square at its place (field_of_dwell in
/// runs/drawing/plot_field.h); lifted moves are not drawn. The unit is s unless options say otherwise. Throws
/// InputError if the path is invalid, dwell has another size, or for colour limits that are none. Cost O(points); about
/// 0.5 s for 10^6.
std::string dwell_picture(const ToolPath& path, const std::vector<double>& dwell, const PictureOptions& options);

}  // namespace dwell
