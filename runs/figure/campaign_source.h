#pragma once

#include <nlohmann/json.hpp>

#include "core/base/progress.h"
#include "runs/figure/campaign.h"
#include "runs/job/job_options.h"

namespace dwell {

/// What campaigns start from, and what that was read from.
struct CampaignSource {
  CampaignStart start;
  nlohmann::ordered_json options, inputs;  // those of the job, as in a plan's summary
};

/// What simulated campaigns of a job start from: its map as the true surface, its tool, path and machine as they are
/// thought. Throws InputError for what campaigns do not simulate (halts, zones to keep out of, a path whose pitch is
/// searched), naming it, and as load_job; Interrupted.
CampaignSource campaign_source(const JobOptions& options, const Progress& progress = {});

}  // namespace dwell
