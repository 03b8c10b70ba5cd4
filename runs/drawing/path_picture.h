#pragma once

#include <string>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A figure of a path over the map that it is planned for [nm]. The map is in colours; the path is drawn on it as the
/// tool runs, through the ends of its strokes, with lifted moves in red, a green square at its first point and a red
/// one at its last. The figure is as large as map and path together. A path whose tracks would lie closer than
/// kClearTrack pixels hides the map: its points are then coloured by their place in the order [%] instead. Throws
/// InputError if the path is not valid, Interrupted. Cost O(pixels + points).
std::string path_picture(const HeightMap& map, const ToolPath& path, const std::string& title,
                         FigureFormat format = FigureFormat::Png, const Progress& progress = {});

/// The same for a square in the middle, about forty tracks wide, but no larger than map and path.
std::string path_detail_picture(const HeightMap& map, const ToolPath& path, const std::string& title,
                                FigureFormat format = FigureFormat::Png, const Progress& progress = {});

inline constexpr double kClearTrack = 6.0;

}  // namespace dwell
