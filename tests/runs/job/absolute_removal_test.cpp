// --removal and --piston: depths to remove with no level that is free.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "runs/job/planned_job.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::small_map;
using test::SmallJob;
using testing::HasSubstr;

/// Options as a command line gives them.
void give(JobOptions& options, const std::string& flag, const std::string& value) {
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.flag == flag) return set_job_option(options, record, value, "--" + flag);
  }
  FAIL() << flag;
}

std::string told(const JobOptions& options, const std::string& flag) {
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.flag == flag) return record.get(options);
  }
  return "no such option";
}

double mean_of(const HeightMap& map) { return map_statistics(map, {}).mean; }

TEST(Piston, IsRemovedToTheLastNanometre) {
  SmallJob job;
  job.options.remove = {true, true};
  job.options.time_price_nm2_per_s = {1e-4};
  give(job.options, "piston", "300");
  const PlannedJob plan = plan_job(job.options);
  EXPECT_FALSE(plan.part().form.piston);
  EXPECT_TRUE(plan.part().form.tilt);
  EXPECT_NEAR(mean_of(plan.part().map), mean_of(small_map()) + 300.0, 1e-9);
  // What is left has no level but a trace that the price of time leaves.
  EXPECT_NEAR(plan.dwell.residual.mean, 0.0, 0.5);
  // The removal is a volume: depth times area over the volume rate, and what falls beside the part.
  const Grid& grid = plan.part().map.grid;
  const double volume =
      mean_of(plan.part().map) * static_cast<double>(plan.part().map.valid_pixels()) * grid.pitch_x * grid.pitch_y;
  EXPECT_GT(plan.dwell.seconds.sum(), volume / plan.part().tif.volume);
  EXPECT_LT(plan.dwell.seconds.sum(), 1.8 * volume / plan.part().tif.volume);
  // A hundred more take a third longer.
  SmallJob more;
  more.options.time_price_nm2_per_s = {1e-4};
  give(more.options, "piston", "400");
  const double longer = plan_job(more.options).dwell.seconds.sum() / plan.dwell.seconds.sum();
  const double deeper = (mean_of(plan.part().map) + 100.0) / mean_of(plan.part().map);
  EXPECT_NEAR(longer, deeper, 0.03);
}

TEST(Piston, IsRefusedWhereNoLevelCounts) {
  SmallJob job;
  give(job.options, "piston", "300");
  EXPECT_EQ(told(job.options, "remove"), "tilt");
  give(job.options, "remove", "piston,tilt");
  expect_input_error([&] { load_job(job.options); }, {"--piston 300", "--remove piston,tilt", "without piston"});
  give(job.options, "remove", "none");
  EXPECT_FALSE(load_job(job.options).part->form.any());
  expect_input_error([&] { give(job.options, "piston", "300nm"); }, {"--piston", "300nm", "(nm)"});
}

TEST(Piston, ThatLeavesDepthsBelowZeroSaysSo) {
  SmallJob job;
  give(job.options, "piston", "0");
  const Job loaded = load_job(job.options);
  Index below = 0;
  for (const double z : loaded.part->map.values) below += z < 0.0 ? 1 : 0;
  ASSERT_GT(below, 0);
  ASSERT_EQ(loaded.options.notes.size(), 1U);
  EXPECT_THAT(loaded.options.notes[0], HasSubstr("below 0 at " + std::to_string(below) + " of "));
  give(job.options, "piston", "300");
  EXPECT_TRUE(load_job(job.options).options.notes.empty());
  SmallJob plain;
  EXPECT_TRUE(load_job(plain.options).options.notes.empty());
}

TEST(Removal, TakesThePlaceOfTheMapWithAllOfItsForm) {
  SmallJob job;
  HeightMap depth = small_map();
  for (double& z : depth.values) z += 40.0;
  const std::string file = (job.folder.path() / "depth.csv").string();
  write_map(file, depth);
  JobOptions as_map = job.options;
  as_map.map = file;
  give(as_map, "remove", "none");
  give(job.options, "removal", file);
  expect_input_error([&] { load_job(job.options); }, {"--removal", "depth.csv", "--map", "map.csv", "one of them"});
  job.options.map.clear();
  EXPECT_EQ(told(job.options, "remove"), "none");
  const PlannedJob removal = plan_job(job.options), map = plan_job(as_map);
  EXPECT_TRUE(removal.dwell.seconds == map.dwell.seconds);
  EXPECT_FALSE(removal.part().form.any());
  EXPECT_EQ(removal.job.inputs[0].role, "removal");
  give(job.options, "remove", "tilt");
  EXPECT_TRUE(load_job(job.options).part->form.tilt);
  job.options.removal.clear();
  expect_input_error([&] { load_job(job.options); }, {"--map: required"});
}

}  // namespace
}  // namespace dwell
