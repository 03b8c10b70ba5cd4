#pragma once

#include <string>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A figure of a path over the map that it is planned for [nm]: the map's colours, the path drawn on it as the tool
/// runs, through the ends of its strokes, lifted moves in red, its first point a green square, its last one a red one.
/// The figure takes in the map and the path. A path whose tracks would lie closer than kClearTrack pixels hides the
/// map: its points are then coloured by their place in the order [%] instead. Throws InputError if the path is not
/// valid, Interrupted. Cost O(pixels + points).
std::string path_picture(const HeightMap& map, const ToolPath& path, const std::string& title,
                         FigureFormat format = FigureFormat::Png, const Progress& progress = {});

/// The same of a square in the middle, as wide as some forty tracks, or as both map and path.
std::string path_detail_picture(const HeightMap& map, const ToolPath& path, const std::string& title,
                                FigureFormat format = FigureFormat::Png, const Progress& progress = {});

inline constexpr double kClearTrack = 6.0;

}  // namespace dwell
