#include "runs/figure/campaign_study.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

TEST(CampaignStudy, DrawsTruthsOfTheirSizeEachOnItsOwn) {
  UncertaintySpec unsure;
  unsure.tif_rate = 0.2, unsure.offset = 0.5, unsure.rotation = 0.3;
  double sum = 0.0, squares = 0.0, shifts = 0.0;
  constexpr int kSamples = 4000;
  for (int sample = 1; sample <= kSamples; ++sample) {
    const CampaignTruth truth = draw_truth(unsure, 3, sample);
    sum += truth.rate - 1.0, squares += std::pow(truth.rate - 1.0, 2), shifts += std::pow(truth.shift.y, 2);
    EXPECT_EQ(truth.width, 1.0);
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.2, 0.01);
  EXPECT_NEAR(std::sqrt(shifts / kSamples), 0.5, 0.03);
  EXPECT_EQ(draw_truth(unsure, 3, 7).rate, draw_truth(unsure, 3, 7).rate);
  EXPECT_NE(draw_truth(unsure, 3, 7).rate, draw_truth(unsure, 4, 7).rate);
}

TEST(CampaignStudy, StatesTheSpreadOfTheCampaignsThatCameSoFar) {
  std::vector<CampaignSample> samples;
  for (int k = 0; k <= 100; ++k) samples.push_back({k + 1, {100.0 - k, 1.0}, {10.0 + k, 2.0}, ""});
  samples[3].left.pop_back(), samples[3].seconds.pop_back();  // ended after its first run
  const std::vector<CampaignSpread> spreads = spreads_of(samples, 3);
  ASSERT_EQ(spreads.size(), 3U);
  EXPECT_DOUBLE_EQ(spreads[0].median, 50.0);
  EXPECT_DOUBLE_EQ(spreads[0].fifth, 5.0);
  EXPECT_DOUBLE_EQ(spreads[0].ninety_fifth, 95.0);
  EXPECT_DOUBLE_EQ(spreads[0].most, 100.0);
  EXPECT_DOUBLE_EQ(spreads[0].seconds, 60.0);
  EXPECT_EQ(spreads[0].samples, 101);
  EXPECT_EQ(spreads[1].samples, 100);
  EXPECT_EQ(spreads[2].samples, 0);
}

}  // namespace
}  // namespace dwell
