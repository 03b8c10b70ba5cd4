#include "runs/plan/sampled_uncertainty.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

TEST(SampledUncertainty, ReadsSizesSamplesAndSeedInAnyOrder) {
  const SampledUncertainty u = parse_sampled_uncertainty("samples=50, tif-rate=5%,seed=7 ,position=20um");
  EXPECT_EQ(u.samples, 50);
  EXPECT_EQ(u.seed, 7U);
  EXPECT_DOUBLE_EQ(u.unsure.tif_rate, 0.05);
  EXPECT_DOUBLE_EQ(u.unsure.position, 0.02);
  EXPECT_EQ(parse_sampled_uncertainty(to_string(u)), u);
  EXPECT_EQ(parse_sampled_uncertainty("metrology=0.2nm").samples, 200);
  EXPECT_EQ(parse_sampled_uncertainty("metrology=0.2nm").seed, 1U);
}

TEST(SampledUncertainty, RefusesWhatItCannotHonour) {
  test::expect_input_error([] { parse_sampled_uncertainty("tif-rate=5%,drift=2%"); }, {"drift=2%", "from run to run"});
  test::expect_input_error([] { parse_sampled_uncertainty("samples=20"); }, {"nothing in it is uncertain"});
  test::expect_input_error([] { parse_sampled_uncertainty("tif-rate=0%"); }, {"nothing in it is uncertain"});
  test::expect_input_error([] { parse_sampled_uncertainty("size=3mm"); },
                           {"'size=3mm'", "accepted: tif-rate=NUMBER%", "of several runs only; samples=N, seed=N"});
  for (const char* text :
       {"tif-rate=5%,samples=1", "tif-rate=5%,samples=2.5", "tif-rate=5%,samples=nan", "tif-rate=5%,seed=-1",
        "tif-rate=5%,samples=20,samples=30", "tif-rate=5%,samples", "tif-rate=5", "samples=20,", ""}) {
    EXPECT_THROW(parse_sampled_uncertainty(text), InputError) << text;
  }
}

}  // namespace
}  // namespace dwell
