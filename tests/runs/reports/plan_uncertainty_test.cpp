#include "runs/reports/plan_uncertainty.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

std::array<double, kUncertainCauses> causes(double rate, double position, double metrology) {
  std::array<double, kUncertainCauses> alone{};
  alone[static_cast<std::size_t>(UncertainCause::Rate)] = rate;
  alone[static_cast<std::size_t>(UncertainCause::Position)] = position;
  alone[static_cast<std::size_t>(UncertainCause::Metrology)] = metrology;
  return alone;
}

TEST(PlanUncertainty, SaysWhichCauseIsMostOfIt) {
  EXPECT_EQ(dominant_sentence(causes(0.01, 0.0961, 0.0164)), "position is most of it: 0.31 of 0.35 nm");
  EXPECT_EQ(dominant_sentence(causes(0.04, 0.04, 0.0625)),
            "no source is most of it; metrology is the largest: 0.25 of 0.377 nm");
  EXPECT_EQ(dominant_sentence(causes(0.0, -0.01, 0.0)), "none of it adds to what is left");
}

TEST(PlanUncertainty, StatesMedianAndRangeOfItsSamples) {
  PlanUncertainty u;
  u.of = parse_sampled_uncertainty("tif-rate=5%,metrology=0.2nm,samples=101");
  u.nominal_rms = 100.0, u.nominal_pv = 7.0;
  for (int k = 0; k <= 100; ++k) u.drawn.samples.push_back({k + 1, 200.0 - k, 2.0 * k});
  u.alone = causes(0.04, 0.0, 0.0);
  EXPECT_EQ(uncertainty_lines(u),
            "uncertain tif-rate=5%,metrology=0.2nm, 101 samples, seed 1\n"
            "          RMS 150 nm in the median, 105 to 195 nm in 90 % of them; 100 nm if all is as it is thought\n"
            "          PV 100 nm in the median, 10 to 190 nm in 90 % of them; 7 nm\n"
            "          each alone adds, in squares: tif-rate 0.2 nm, metrology 0 nm\n"
            "          tif-rate is most of it: 0.2 of 0.2 nm\n");
  const auto block = uncertainty_block(u);
  EXPECT_EQ(block["rms_nm"]["median"], 150.0);
  EXPECT_EQ(block["pv_nm"]["p95"], 190.0);
  EXPECT_EQ(block["causes"].size(), 2U);
  EXPECT_EQ(block["dominant"], "tif-rate");
  EXPECT_EQ(block["samples"].size(), 101U);
}

}  // namespace
}  // namespace dwell
