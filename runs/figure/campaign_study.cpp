#include "runs/figure/campaign_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random_numbers.h"
#include "core/numerics/quantile.h"

namespace dwell {
namespace {

/// The seed of a sample: far from those of its neighbours and of other seeds.
unsigned seed_of(unsigned seed, int sample) { return seed * 2654435761U + static_cast<unsigned>(sample) * 40503U + 1U; }

}  // namespace

CampaignTruth draw_truth(const UncertaintySpec& unsure, unsigned seed, int sample) {
  RandomNumbers random(seed_of(seed, sample));
  CampaignTruth truth;
  constexpr double kLeastFactor = 0.05;  // a tool removes, whatever is drawn
  truth.rate = std::max(kLeastFactor, 1.0 + unsure.tif_rate * random.normal());
  truth.width = std::max(kLeastFactor, 1.0 + unsure.tif_width * random.normal());
  truth.shift = {unsure.offset * random.normal(), unsure.offset * random.normal()};
  truth.degrees = unsure.rotation * random.normal();
  truth.drift = unsure.drift, truth.noise = unsure.metrology, truth.position = unsure.position;
  return truth;
}

CampaignStudy study_campaigns(const CampaignStart& start, const UncertaintySpec& unsure,
                              const CampaignLearning& learning, int runs, int first, int end, unsigned seed,
                              const Progress& progress) {
  CampaignStudy study;
  study.first = first;
  for (int sample = first; sample < end; ++sample) {
    const Progress here = progress.of_part(fmt::format("campaign {} of {} to {}", sample, first, end - 1));
    const Campaign campaign = simulate_campaign(start, draw_truth(unsure, seed, sample), learning, runs,
                                                seed_of(seed, sample) ^ 0x5bd1e995U, here);
    std::vector<double> left, seconds;
    for (const CampaignRun& run : campaign.runs) left.push_back(run.after), seconds.push_back(run.seconds);
    study.left.push_back(std::move(left));
    study.seconds.push_back(std::move(seconds));
    if (!campaign.fault.empty()) study.faults.push_back(fmt::format("campaign {}: {}", sample, campaign.fault));
  }
  return study;
}

std::vector<CampaignSpread> spreads_of(const CampaignStudy& study, int runs) {
  std::vector<CampaignSpread> spreads;
  for (std::size_t run = 0; run < static_cast<std::size_t>(runs); ++run) {
    std::vector<double> left, seconds;
    for (std::size_t k = 0; k < study.left.size(); ++k) {
      if (study.left[k].size() <= run) continue;
      left.push_back(study.left[k][run]);
      seconds.push_back(study.seconds[k][run]);
    }
    CampaignSpread spread;
    spread.samples = static_cast<int>(left.size());
    if (!left.empty()) {
      std::sort(left.begin(), left.end());
      std::sort(seconds.begin(), seconds.end());
      spread = {left.front(), quantile(left, 0.05),   quantile(left, 0.5), quantile(left, 0.95),
                left.back(),  quantile(seconds, 0.5), spread.samples};
    }
    spreads.push_back(spread);
  }
  return spreads;
}

}  // namespace dwell
