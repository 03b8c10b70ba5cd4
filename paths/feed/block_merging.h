#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "core/motion/tool_path.h"

namespace dwell {

/// A path with fewer strokes, so that each lasts as long as a controller takes for a block.
struct MergedPath {
  ToolPath path;
  std::size_t blocks_before = 0, blocks_after = 0;  // moves at work: a stroke that turns at its point is two
  std::size_t short_before = 0;                     // of the former, those below the least time
};

/// Merges strokes that are run in less than `least_seconds` with their neighbours straight on. `seconds`: of every
/// stroke of the path under continuous motion. The way of the tool stays as it is: stretches between lifts that hold a
/// short block get new dwell points, at their corners and between them so far apart that a block takes its least time,
/// or as long as the strokes there are where these take longer. Between corners that are closer than two blocks nothing
/// can be merged; there the feed must be low (least_block_seconds). Stretches without short blocks keep their points.
/// Cost O(points).
MergedPath merge_short_blocks(const ToolPath& path, const Eigen::VectorXd& seconds, double least_seconds);

}  // namespace dwell
