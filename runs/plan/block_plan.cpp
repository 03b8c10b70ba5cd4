#include "runs/plan/block_plan.h"

#include <cmath>
#include <limits>
#include <utility>

#include "paths/feed/block_merging.h"
#include "runs/plan/least_dwell_of.h"

namespace dwell {
namespace {

// The plan on the merged path has other dwell times than the one that said what to merge.
constexpr double kSpare = 1.1;
constexpr double kAtBound = 1e-9;  // relative

MachineLimits without_block_rate(MachineLimits limits) {
  limits.machine->controller.max_blocks_per_s = std::numeric_limits<double>::infinity();
  return limits;
}

}  // namespace

std::optional<BlockMerging> merge_blocks(const Part& part, LaidPath& laid, const DwellOptions& options,
                                         const Progress& progress) {
  const std::optional<Machine>& machine = options.machine.machine;
  if (!machine || !std::isfinite(machine->controller.max_blocks_per_s) || laid.motion != Motion::Moving)
    return std::nullopt;
  DwellOptions free = options;
  free.machine = without_block_rate(options.machine);
  free.rounds = 0;
  const DwellPlan plan = find_dwell(part, laid, free, progress.of_part("blocks"));
  MergedPath merged = merge_short_blocks(laid.path, plan.seconds, kSpare * least_block_seconds(*machine));
  BlockMerging blocks;
  const std::size_t a_move = options.schedule == ScheduleKind::Constant ? 1 : 2;
  blocks.before = a_move * merged.blocks_before;
  blocks.after = a_move * merged.blocks_after;
  blocks.short_before = a_move * merged.short_before;
  blocks.rms_before = plan.residual.rms_about_zero();
  if (merged.short_before > 0) laid = lay_path(std::move(merged.path), laid.motion);
  return blocks;
}

Index strokes_bounded_by_blocks(const LaidPath& laid, const DwellPlan& dwell, const MachineLimits& machine) {
  const Eigen::VectorXd least = least_dwell_of(laid, machine), free = least_dwell_of(laid, without_block_rate(machine));
  Index count = 0;
  for (Index j = 0; j < least.size(); ++j) {
    const bool by_blocks = least[j] > free[j] * (1.0 + kAtBound);
    count += static_cast<Index>(by_blocks && dwell.seconds[j] <= least[j] * (1.0 + kAtBound));
  }
  return count;
}

}  // namespace dwell
