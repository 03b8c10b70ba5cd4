#pragma once

#include "core/base/progress.h"
#include "runs/base/output_folder.h"
#include "runs/job/planned_job.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// Writes the pictures of a plan into its folder: surface before and after, what is left, dwell, path and a detail of
/// it, in every format that the job asks for. Throws InputError, Interrupted.
void write_plan_pictures(const PlannedJob& plan, const WrittenPlan& written, const OutputFolder& folder,
                         const Progress& progress);

}  // namespace dwell
