#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// What the cheap feed is made from.
struct DepthFeedJob {
  double volume = 0.0;  // volume rate of the removal function [nm mm^2/s], finite and > 0
  double lowest = 0.0;  // height of the target that counts as depth 0 [nm], finite
  double max_feed = std::numeric_limits<double>::infinity();  // [mm/s], > 0
  /// Length of line that a dwell point stands for [mm], > 0 (MultiPitchPath::step); infinite: its stroke's. Where a
  /// line ends, the stroke holds half of the move to the next line as well, which asks for no removal of its own: with
  /// the step given it is passed faster, as far as max_feed allows.
  double step = std::numeric_limits<double>::infinity();
};

/// Feed by local depth alone: v = volume / (pitch depth) (Hou, Liao, Wang 2017, eq. 12), at most max_feed. It knows
/// nothing of the removal function's width, so it blurs the target by it; the solver's dwell does not. For estimates of
/// time, for a first dwell, and where depth changes little over the size of the tool.
struct DepthFeed {
  std::vector<double> speed;   // at every dwell point, stroke length / dwell [mm/s]; 0 for a halt
  Eigen::VectorXd dwell;       // step / v [s], one a dwell point; 0 at unlimited speed
  std::size_t limited = 0;     // points where max_feed acted: more is removed there than wanted
  double total_seconds = 0.0;  // sum of the dwell
};

/// target: heights to remove [nm], NaN = outside. pitch: distance between neighbouring lines at every dwell point [mm],
/// finite and > 0 (MultiPitchPath::pitch_of_points). Depth at a dwell point: bilinear between the pixels, those without
/// data and beyond the map taken from the nearest valid one; what lies below `lowest` counts as depth 0. Strokes as of
/// a moving tool. Throws InputError naming what is out of range, or the two sizes if they differ. Cost O(pixels +
/// points).
DepthFeed depth_feed(const HeightMap& target, const ToolPath& path, const std::vector<double>& pitch,
                     const DepthFeedJob& job, const Progress& progress = {});

}  // namespace dwell
