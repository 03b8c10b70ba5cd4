#pragma once

#include <cstddef>
#include <optional>

#include "core/base/progress.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// What a controller's block rate did to a plan.
struct BlockMerging {
  std::size_t before = 0,
              after = 0;         // blocks at work, of the path as it was laid and as it is run; two a move with speeds
  std::size_t short_before = 0;  // of the former, in a plan that knows no block rate
  Index bounded = 0;             // strokes as fast as the block rate allows, and slower than the machine could
  double rms_before = 0.0;       // planned without the block rate, about zero [nm]
};

/// `options.machine` allows for the blocks that a move is. Plans without the block rate of options' machine, and merges
/// the strokes of the path that are then too short (merge_short_blocks): `laid` becomes the path to plan on. Nothing,
/// and no work, where the machine has no block rate or the tool halts at its points. Throws as find_dwell. Cost: a plan
/// without correction for the motion.
std::optional<BlockMerging> merge_blocks(const Part& part, LaidPath& laid, const DwellOptions& options,
                                         const Progress& progress);

/// Of a plan: its strokes that the block rate bounds.
Index strokes_bounded_by_blocks(const LaidPath& laid, const DwellPlan& dwell, const MachineLimits& machine);

}  // namespace dwell
