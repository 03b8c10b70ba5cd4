#pragma once

#include "runs/base/merged_parts.h"
#include "runs/base/sweep_part.h"
#include "runs/campaigns/pareto.h"

namespace dwell {

/// The command whose parts these are.
inline constexpr const char* kParetoCommand = "pareto";

/// What a shard of a sweep has come to.
SweepPart pareto_part(const ParetoSweep& sweep, const Shard& shard);

/// The whole sweep, put together from its parts and concluded.
ParetoSweep merged_pareto(const MergedParts& parts);

}  // namespace dwell
