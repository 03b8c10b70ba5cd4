#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "runs/figure/campaign_study.h"

namespace dwell {

/// What a study of campaigns was made of, for its report.
struct CampaignQuestion {
  std::string run;     // folder, or the job
  std::string unsure;  // an UncertaintySpec as text; empty: nothing
  int runs = 0, samples = 0;
  unsigned seed = 0;
  bool learns = true;
  double before = 0.0;  // RMS before the first run [nm]
};

/// A line for each run: median, 5 % and 95 % and most of the RMS that is left, and the dwell.
std::string campaign_text(const CampaignQuestion& question, const std::vector<CampaignSample>& samples);

/// The same with every campaign (docs/json.md).
nlohmann::ordered_json campaign_json(const CampaignQuestion& question, const std::vector<CampaignSample>& samples);

}  // namespace dwell
