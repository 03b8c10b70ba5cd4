#include "runs/figure/campaign_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::vector<CampaignSample> study_campaigns(const CampaignStart& start, const UncertaintySpec& unsure,
                                            const CampaignLearning& learning, int runs,
                                            const std::vector<std::size_t>& numbers, unsigned seed,
                                            const Progress& progress) {
  std::vector<CampaignSample> samples;
  for (const std::size_t number : numbers) {
    const auto sample = static_cast<int>(number);
    const Progress here =
        progress.of_part(fmt::format("campaign {}, {} of {}", number, samples.size() + 1, numbers.size()));
    const Campaign campaign = simulate_campaign(start, draw_truth(unsure, seed, sample), learning, runs,
                                                seed_of(seed, sample) ^ 0x5bd1e995U, here);
    samples.push_back({sample, {}, {}, campaign.fault});
    for (const CampaignRun& run : campaign.runs) {
      samples.back().left.push_back(run.after);
      samples.back().seconds.push_back(run.seconds);
    }
  }
  return samples;
}

std::vector<CampaignSpread> spreads_of(const std::vector<CampaignSample>& samples, int runs) {
  std::vector<CampaignSpread> spreads;
  for (std::size_t run = 0; run < static_cast<std::size_t>(runs); ++run) {
    std::vector<double> left, seconds;
    for (const CampaignSample& sample : samples) {
      if (sample.left.size() <= run) continue;
      left.push_back(sample.left[run]);
      seconds.push_back(sample.seconds[run]);
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
