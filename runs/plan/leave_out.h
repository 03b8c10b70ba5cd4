#pragma once

#include "core/base/progress.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// The plan of the same part and path whose fit leaves out the blemishes that are found in what `plan` leaves: their
/// pixels have weight 0 and influence neither the dwell nor the form terms. What it states is of all pixels, those too;
/// `left_out` says what is left on the others. Weights that the options leave open are found anew, since they belong to
/// the problem. Without blemishes it is `plan` with nothing left out. Throws as find_dwell does; where
/// options.max_seconds are over, `plan` is returned and a limit says so. Cost: find_blemishes, a solve, and one
/// prediction.
DwellPlan leave_out_blemishes(const Part& part, const LaidPath& laid, DwellPlan plan, const DwellOptions& options,
                              const Progress& progress = {});

/// The plan whose fit leaves out these pixels; what it states is of all. Throws as find_dwell does. Cost: a solve and
/// one prediction.
DwellPlan find_without(const Part& part, const LaidPath& laid, LeftOut left_out, const Vector& start,
                       const DwellOptions& options, const Progress& progress = {});

}  // namespace dwell
