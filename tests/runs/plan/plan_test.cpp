#include "runs/plan/plan.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/plan_files.h"
#include "runs/plan/plan_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::small_map;
using test::SmallJob;

double rms_after(const Plan& plan, const Program& program) {
  return map_statistics(surface_after(plan.map, simulate(program, plan.map, plan.kernel, 1)), plan.terms).rms;
}

TEST(MakePlan, CorrectsTheMapAndItsCertificateSaysTheSameResidual) {
  const SmallJob job;
  const Plan plan = make_plan(job.options, {});
  EXPECT_TRUE(plan.limits.empty());
  EXPECT_LE(plan.residual.rms, 0.1 * plan.before.rms);
  EXPECT_GT(plan.residual.rms, 0.0);
  EXPECT_NEAR(plan.certificate.residual_rms, plan.residual.rms, 1e-9 * plan.residual.rms);
  EXPECT_LE(plan.certificate.bound_violation, 0.0);
  EXPECT_LE(plan.certificate.projected_gradient, 1e-3);
  EXPECT_EQ(plan.map_pixels, small_map().valid_pixels());
}

TEST(MakePlan, PreparesItsMapAndSaysHow) {
  SmallJob job;
  job.options.map_steps = "crop:rect:-4.25,1.75,8,12;fill:all";
  const Plan plan = make_plan(job.options, {});
  EXPECT_EQ(plan.map.grid.cols, 25);
  EXPECT_EQ(plan.map.valid_pixels(), plan.map.grid.size());
  EXPECT_EQ(plan.map_pixels, plan.map.grid.size());
  ASSERT_EQ(plan.map.history.size(), 2u);
  OutputFolder folder(job.options.out, plan_files());
  Plan written = plan;
  const auto summary = nlohmann::json::parse(write_plan(written, folder, {}).summary);
  EXPECT_EQ(summary["map"]["history"], plan.map.history);
  EXPECT_EQ(summary["options"]["map_steps"], job.options.map_steps);
  EXPECT_NE(plan.map.history[1].find("fill:how=harmonic,all (1 holes"), std::string::npos) << plan.map.history[1];
}

TEST(MakePlan, KeepsTheLowerBoundsOfTimeAndFeed) {
  SmallJob job;
  job.options.min_dwell_s = 0.15;
  job.options.max_feed_mm_per_min = 300.0;  // 5 mm/s: a stroke of 1 mm takes 0.2 s
  const Plan plan = make_plan(job.options, {});
  Index at_limit = 0;
  for (std::size_t j = 0; j < plan.strokes.size(); ++j) {
    const double least = std::max(0.15, plan.strokes[j].length() / 5.0);
    const double dwell = plan.dwell[static_cast<Index>(j)];
    EXPECT_GE(dwell, least) << j;
    if (dwell <= least * (1.0 + 1e-9)) ++at_limit;
    EXPECT_LE(plan.table.feed_mm_per_min[j], 300.0);
  }
  EXPECT_GT(at_limit, 0);
  EXPECT_EQ(plan.feed.segments_limited, at_limit);
  EXPECT_EQ(plan.feed.segments_infeasible, 0);
  EXPECT_LE(units::mm_per_min(plan.feed.max_speed), 300.0 * (1.0 + 1e-12));
}

TEST(MakePlan, PredictsWhatTheRunningToolDoes) {
  const SmallJob job;
  const Plan plan = make_plan(job.options, {});
  EXPECT_NEAR(rms_after(plan, program_of(plan.table)), plan.residual.rms, 1e-3 * plan.residual.rms);
}

TEST(MakePlan, StopMotionCountsWhatTheMovesBetweenHaltsRemove) {
  SmallJob job;
  job.options.motion = "stop";
  job.options.max_feed_mm_per_min = 600.0;
  const Plan plan = make_plan(job.options, {});
  EXPECT_NEAR(rms_after(plan, program_of(plan.table)), plan.residual.rms, 1e-3 * plan.residual.rms);
  // Not counting them would show: the halts alone leave another surface.
  Program halts = program_of(plan.table);
  for (ProgramStep& step : halts.steps) step.removes = step.removes && step.start == step.finish;
  EXPECT_GT(std::abs(rms_after(plan, halts) - plan.residual.rms), 0.1 * plan.residual.rms);
}

TEST(MakePlan, PlansForTheApertureAlone) {
  for (const char* aperture : {"rect:0,3,6,9.3", "circle:3,6,3.3"}) {
    SmallJob job;
    job.options.aperture = aperture;
    const Plan plan = make_plan(job.options, {});
    const HeightMap whole = small_map();
    Index expected = 0;
    for (Index i = 0; i < whole.grid.size(); ++i) {
      const Point p = whole.grid.centre(i);
      const bool inside =
          aperture[0] == 'r' ? p.x >= 0 && p.x <= 6 && p.y >= 3 && p.y <= 9.3 : std::hypot(p.x - 3.0, p.y - 6.0) <= 3.3;
      const bool counts = inside && std::isfinite(whole.values[static_cast<std::size_t>(i)]);
      expected += counts;
      EXPECT_EQ(std::isfinite(plan.map.values[static_cast<std::size_t>(i)]), counts) << aperture << " pixel " << i;
    }
    EXPECT_EQ(plan.before.valid_pixels, expected) << aperture;
    EXPECT_EQ(plan.residual.valid_pixels, expected) << aperture;
    EXPECT_LE(plan.residual.rms, 0.1 * plan.before.rms) << aperture;
  }
}

TEST(MakePlan, FollowsANearestNeighbourPath) {
  SmallJob job;
  job.options.path = "nearest:cell=1,critical=-inf";
  const Plan plan = make_plan(job.options, {});
  EXPECT_EQ(plan.path.kind, "nearest");
  EXPECT_LE(plan.residual.rms, 0.5 * plan.before.rms);
  EXPECT_NEAR(rms_after(plan, program_of(plan.table)), plan.residual.rms, 1e-3 * plan.residual.rms);
}

TEST(MakePlan, FollowsAPathFromAFile) {
  SmallJob job;
  std::string text = "x_mm,y_mm,lift\n";
  for (int line = 0; line < 13; ++line) {
    for (int k = 0; k < 17; ++k) {
      const int column = line % 2 == 0 ? k : 16 - k;
      text +=
          std::to_string(column - 5) + "," + std::to_string(line + 1) + "," + (line == 6 && k == 0 ? "1" : "0") + "\n";
    }
  }
  const std::filesystem::path file = job.folder.file("path.csv", text);
  job.options.path = "file:" + file.string();
  const Plan plan = make_plan(job.options, {});
  ASSERT_EQ(plan.path.size(), 13u * 17u);
  EXPECT_EQ(plan.path.points[17].x, 11.0);
  EXPECT_EQ(plan.path.points[17].y, 2.0);
  EXPECT_EQ(plan.metrics.lifts, 1);
  ASSERT_EQ(plan.inputs.size(), 2u);  // map and path; the tool is a formula
  EXPECT_EQ(plan.inputs[1].role, "path");
  EXPECT_EQ(plan.inputs[1].sha256, sha256_of_file(file));
  EXPECT_LE(plan.residual.rms, 0.2 * plan.before.rms);
}

TEST(MakePlan, SaysWhichInputIsMissing) {
  SmallJob job;
  job.options.path.clear();
  expect_input_error([&] { make_plan(job.options, {}); }, {"--path", "raster:pitch=1"});
  job.options.tif.clear();
  expect_input_error([&] { make_plan(job.options, {}); }, {"--tif"});
  job.options.map.clear();
  expect_input_error([&] { make_plan(job.options, {}); }, {"--map"});
}

TEST(MakePlan, StopsWhenAskedAndReportsEveryStage) {
  const SmallJob job;
  std::vector<std::string> lines;
  Progress progress;
  progress.show = [&lines](const std::string& line) { lines.push_back(line); };
  progress.stop = [&lines] { return !lines.empty() && lines.back().starts_with("solve"); };
  EXPECT_THROW(make_plan(job.options, progress), Interrupted);
  ASSERT_GE(lines.size(), 3u);
  EXPECT_TRUE(lines[0].starts_with("map: 22 x 30 pixels"));
  EXPECT_TRUE(lines[1].starts_with("path:"));
}

std::map<std::string, std::string> written_files(const JobOptions& options) {
  Plan plan = make_plan(options, {});
  OutputFolder folder(options.out, plan_files());
  write_plan(plan, folder, {});
  folder.commit();
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(options.out))
    files[entry.path().filename().string()] = read_whole_file(entry.path());
  return files;
}

nlohmann::json without_wall_time(const std::string& summary) {
  nlohmann::json json = nlohmann::json::parse(summary);
  EXPECT_EQ(json["solve"].erase("wall_s"), 1u);
  return json;
}

TEST(WritePlan, TheSameJobGivesTheSameBytesButForTheWallTime) {
  SmallJob job;
  job.options.time_price_nm2_per_s = {0.0, GoalKind::Corner};
  const auto one = written_files(job.options), two = written_files(job.options);
  EXPECT_EQ(one.size(), plan_files().others.size() + 1);
  for (const auto& [name, bytes] : one) {
    const std::string file(name);
    EXPECT_TRUE(plan_files().has(file)) << file;
    ASSERT_TRUE(one.contains(file) && two.contains(file)) << file;
    EXPECT_FALSE(one.at(file).empty()) << file;
    if (name == "summary.json") {
      EXPECT_EQ(without_wall_time(one.at(file)), without_wall_time(two.at(file)));
    } else {
      EXPECT_TRUE(one.at(file) == two.at(file)) << file;
    }
  }
}

TEST(WritePlan, ProgramOnDiskLeavesWhatTheSolverPredicts) {
  for (const char* motion : {"moving", "stop"}) {
    SmallJob job;
    job.options.motion = motion;
    Plan plan = make_plan(job.options, {});
    const OutputFolder folder(job.options.out, plan_files());
    const WrittenPlan written = write_plan(plan, folder, {});
    EXPECT_NEAR(written.simulated.rms, plan.residual.rms, 1e-3 * plan.residual.rms) << motion;
    EXPECT_TRUE(plan.limits.empty()) << motion;
  }
}

TEST(MakePlan, OneAndTwoThreadsAgree) {
  SmallJob job;
  const Plan one = make_plan(job.options, {});
  job.options.threads = 2;
  const Plan two = make_plan(job.options, {});
  EXPECT_EQ(two.threads, 2);
  EXPECT_NEAR(two.residual.rms, one.residual.rms, 1e-6 * one.residual.rms);
  EXPECT_NEAR(two.dwell.sum(), one.dwell.sum(), 1e-6 * one.dwell.sum());
  EXPECT_LE((two.dwell - one.dwell).norm(), 1e-6 * one.dwell.norm());
}

}  // namespace
}  // namespace dwell
