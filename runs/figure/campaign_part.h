#pragma once

#include <nlohmann/json.hpp>

#include <vector>

#include "runs/base/merged_parts.h"
#include "runs/base/sweep_part.h"
#include "runs/figure/campaign_report.h"
#include "runs/figure/campaign_source.h"

namespace dwell {

/// The command whose parts these are.
inline constexpr const char* kCampaignsCommand = "figure simulate";

/// What a shard of the campaigns has come to; `samples` are its tasks'.
SweepPart campaign_part(const CampaignQuestion& question, const CampaignSource& source, const Shard& shard,
                        const std::vector<CampaignSample>& samples);

/// All campaigns, put together from their parts: what campaign_text and campaign_json make their reports of.
struct MergedCampaigns {
  CampaignQuestion question;
  std::vector<CampaignSample> samples;
};
MergedCampaigns merged_campaigns(const MergedParts& parts);

}  // namespace dwell
