#pragma once

#include "core/base/progress.h"
#include "runs/figure/campaign.h"
#include "runs/job/job_options.h"

namespace dwell {

/// What simulated campaigns of a job start from: its map as the true surface, its tool, path and machine as they are
/// thought. Throws InputError for what campaigns do not simulate (halts, zones to keep out of, a path whose pitch is
/// searched), naming it, and as load_job; Interrupted.
CampaignStart campaign_start(const JobOptions& options, const Progress& progress = {});

}  // namespace dwell
