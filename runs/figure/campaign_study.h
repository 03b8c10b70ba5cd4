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

/// Many simulated campaigns of one shop.
struct CampaignStudy {
  std::vector<std::vector<double>> left;     // RMS after every run [nm], a campaign each
  std::vector<std::vector<double>> seconds;  // of dwell of every run
  std::vector<std::string> faults;           // errors of orientation that ended a campaign
  int first = 1;                             // number of the first campaign
};

/// A truth as an uncertainty says it may be, the `sample`-th (1, 2, ...) of a seed. Every sample is drawn on its own,
/// so that any of them can be made anywhere.
CampaignTruth draw_truth(const UncertaintySpec& unsure, unsigned seed, int sample);

/// Simulates campaigns first, first + 1, ... below `end` (1-based). Throws as simulate_campaign, which costs most.
CampaignStudy study_campaigns(const CampaignStart& start, const UncertaintySpec& unsure,
                              const CampaignLearning& learning, int runs, int first, int end, unsigned seed,
                              const Progress& progress = {});

/// The spread after each run, by the campaigns that came so far.
std::vector<CampaignSpread> spreads_of(const CampaignStudy& study, int runs);

}  // namespace dwell
