#pragma once

#include <vector>

#include "core/base/progress.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// A plan of dwell times that are known: nothing is solved, and the certificate says how far they are from the optimum
/// for this part, which may be another than the one they were found for. `commanded`: of every stroke length / feed, of
/// halts the dwell [s]; with a machine the times are those that it then takes, as options.machine has it, with feeds
/// (ScheduleKind::Constant). `weights` are those of the objective. Throws InputError for another number of times than
/// strokes, Interrupted. Cost: the removal operator's setup, some applications of it, and with a machine one
/// simulation.
DwellPlan keep_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Weights& weights,
                     const std::vector<double>& commanded, const Progress& progress = {});

}  // namespace dwell
