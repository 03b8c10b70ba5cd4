#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "paths/feed/binding_limits.h"
#include "paths/feed/motion_nodes.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A figure of a motion over the part (white), each stretch at work in the colour of the limit that binds there, with
/// a key that says how long each does. `limits`: of every stretch (binding_limits). Throws Interrupted. Cost O(pixels
/// of the figure + nodes).
std::string limit_picture(const HeightMap& map, const std::vector<MotionNode>& nodes,
                          const std::vector<BindingLimit>& limits, const std::string& title,
                          FigureFormat format = FigureFormat::Png, const Progress& progress = {});

/// A figure of speed [mm/s] and acceleration along the path [mm/s^2] over time, lifted moves left out. Of more
/// stretches than a line can show, equal times are drawn by their least and largest values. Cost O(nodes).
std::string speed_picture(const std::vector<MotionNode>& nodes, const std::string& title,
                          FigureFormat format = FigureFormat::Png);

}  // namespace dwell
