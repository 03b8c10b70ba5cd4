#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/figure/campaign.h"
#include "runs/plan/uncertainty_spec.h"

namespace dwell {

/// The middle and the range of what many campaigns leave after a run.
struct CampaignSpread {
  double least = 0.0, fifth = 0.0, median = 0.0, ninety_fifth = 0.0, most = 0.0;  // RMS [nm]; 5 % and 95 %
  double seconds = 0.0;                                                           // of dwell, median
  int samples = 0;                                                                // that came so far
};

/// One simulated campaign of many.
struct CampaignSample {
  int number = 1;
  std::vector<double> left;     // RMS after every run [nm]
  std::vector<double> seconds;  // of dwell of every run
  std::string fault;            // the error of orientation that ended it; else empty
};

/// A truth as an uncertainty says it may be, the `sample`-th (1, 2, ...) of a seed. Every sample is drawn on its own,
/// so that any of them can be made anywhere.
CampaignTruth draw_truth(const UncertaintySpec& unsure, unsigned seed, int sample);

/// Simulates the campaigns of these numbers (1, 2, ...), each on its own. Throws as simulate_campaign, which costs
/// most.
std::vector<CampaignSample> study_campaigns(const CampaignStart& start, const UncertaintySpec& unsure,
                                            const CampaignLearning& learning, int runs,
                                            const std::vector<std::size_t>& numbers, unsigned seed,
                                            const Progress& progress = {});

/// The spread after each run, by the campaigns that came so far.
std::vector<CampaignSpread> spreads_of(const std::vector<CampaignSample>& samples, int runs);

}  // namespace dwell
