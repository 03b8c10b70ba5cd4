#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// What depth_feed needs besides the target and the path.
struct DepthFeedJob {
  double volume = 0.0;  // volume rate of the removal function [nm mm^2/s], finite and > 0
  double lowest = 0.0;  // height of the target that counts as depth 0 [nm], finite
  double max_feed = std::numeric_limits<double>::infinity();  // [mm/s], > 0
  /// Length of line that a dwell point stands for [mm], > 0 (MultiPitchPath::step); infinite: its stroke's. At the end
  /// of a line, the stroke also holds half of the move to the next line, which needs no removal of its own: with the
  /// step given, such a stroke is run faster, as far as max_feed allows.
  double step = std::numeric_limits<double>::infinity();
};

/// Feed by local depth alone: v = volume / (pitch depth) (Hou, Liao, Wang 2017, eq. 12), at most max_feed. It ignores
/// the width of the removal function, so the removal is the target blurred by it; the solver's dwell avoids that. For
/// estimates of time, for a first dwell, and where depth changes little over the size of the tool.
struct DepthFeed {
  std::vector<double> speed;   // at every dwell point, stroke length / dwell [mm/s]; 0 for a halt
  Eigen::VectorXd dwell;       // step / v [s], one a dwell point; 0 at unlimited speed
  std::size_t limited = 0;     // points at max_feed, where more is removed than wanted
  double total_seconds = 0.0;  // sum of the dwell
};

/// target: heights to remove [nm], NaN = outside. pitch: distance between neighbouring lines at every dwell point [mm],
/// finite and > 0 (MultiPitchPath::pitch_of_points). The depth at a dwell point is interpolated bilinearly; pixels
/// without data and beyond the map have the height of the nearest valid one, and what lies below `lowest` counts as
/// depth 0. The strokes are those of a moving tool. Throws InputError naming what is out of range, or the two sizes if
/// they differ. Cost O(pixels + points).
DepthFeed depth_feed(const HeightMap& target, const ToolPath& path, const std::vector<double>& pitch,
                     const DepthFeedJob& job, const Progress& progress = {});

}  // namespace dwell
