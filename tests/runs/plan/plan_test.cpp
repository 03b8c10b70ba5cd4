#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/job/planned_job.h"
#include "runs/programs/program_formats.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::small_map;
using test::SmallJob;

double rms_after(const PlannedJob& plan, const Program& program) {
  return map_statistics(surface_after(plan.part().map, simulate(program, plan.part().map, plan.part().kernel, 1)),
                        plan.part().form)
      .rms;
}

TEST(MakePlan, CorrectsTheMapAndItsCertificateSaysTheSameResidual) {
  const SmallJob job;
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_LE(plan.dwell.residual.rms, 0.1 * plan.part().before.rms);
  EXPECT_GT(plan.dwell.residual.rms, 0.0);
  EXPECT_NEAR(plan.dwell.certificate.residual_rms, plan.dwell.residual.rms, 1e-9 * plan.dwell.residual.rms);
  EXPECT_LE(plan.dwell.certificate.bound_violation, 0.0);
  EXPECT_LE(plan.dwell.certificate.projected_gradient, 1e-3);
  EXPECT_EQ(plan.job.map_pixels, small_map().valid_pixels());
}

TEST(MakePlan, PreparesItsMapAndSaysHow) {
  SmallJob job;
  job.options.map_steps = "crop:rect:-4.25,1.75,8,12;fill:all";
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_EQ(plan.part().map.grid.cols, 25);
  EXPECT_EQ(plan.part().map.valid_pixels(), plan.part().map.grid.size());
  EXPECT_EQ(plan.job.map_pixels, plan.part().map.grid.size());
  ASSERT_EQ(plan.part().map.history.size(), 2u);
  const OutputFolder folder(job.options.out, plan_files());
  const auto summary = nlohmann::json::parse(write_plan(plan, folder, {}).summary);
  EXPECT_EQ(summary["map"]["history"], plan.part().map.history);
  EXPECT_EQ(summary["options"]["map_steps"], job.options.map_steps);
  EXPECT_NE(plan.part().map.history[1].find("fill:how=harmonic,all (1 hole"), std::string::npos)
      << plan.part().map.history[1];
}

TEST(MakePlan, KeepsTheLowerBoundsOfTimeAndFeed) {
  SmallJob job;
  job.options.min_dwell_s = 0.15;
  job.options.max_feed_mm_per_min = 300.0;  // 5 mm/s: a stroke of 1 mm takes 0.2 s
  const PlannedJob plan = plan_job(job.options, {});
  Index at_limit = 0;
  for (std::size_t j = 0; j < plan.laid.strokes.size(); ++j) {
    const double least = std::max(0.15, plan.laid.strokes[j].length() / 5.0);
    const double dwell = plan.dwell.seconds[static_cast<Index>(j)];
    EXPECT_GE(dwell, least) << j;
    if (dwell <= least * (1.0 + 1e-9)) ++at_limit;
    EXPECT_LE(plan.program.table.feed_mm_per_min[j], 300.0);
  }
  EXPECT_GT(at_limit, 0);
  EXPECT_EQ(plan.program.feed.segments_limited, at_limit);
  EXPECT_EQ(plan.program.feed.segments_infeasible, 0);
  EXPECT_LE(units::mm_per_min(plan.program.feed.max_speed), 300.0 * (1.0 + 1e-12));
}

TEST(MakePlan, PredictsWhatTheRunningToolDoes) {
  const SmallJob job;
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_NEAR(rms_after(plan, program_of(plan.program.table)), plan.dwell.residual.rms, 1e-3 * plan.dwell.residual.rms);
}

TEST(MakePlan, StopMotionCountsWhatTheMovesBetweenHaltsRemove) {
  SmallJob job;
  job.options.motion = Motion::Stop;
  job.options.max_feed_mm_per_min = 600.0;
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_NEAR(rms_after(plan, program_of(plan.program.table)), plan.dwell.residual.rms, 1e-3 * plan.dwell.residual.rms);
  // Not counting them would show: the halts alone leave another surface.
  Program halts = program_of(plan.program.table);
  for (ProgramStep& step : halts.steps) step.removes = step.removes && step.start == step.finish;
  EXPECT_GT(std::abs(rms_after(plan, halts) - plan.dwell.residual.rms), 0.1 * plan.dwell.residual.rms);
}

// The rest of the error is left on purpose, and is part of every residual that is stated.
TEST(MakePlan, RemovesTheFractionOfTheErrorThatIsAskedFor) {
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    SmallJob job;
    job.options.motion = motion;
    const PlannedJob whole = plan_job(job.options, {});
    job.options.fraction = 0.75;
    const PlannedJob plan = plan_job(job.options, {});
    const double spared = 0.25 * plan.part().before.rms;
    EXPECT_NEAR(plan.dwell.residual.rms, spared, 0.1 * spared);
    EXPECT_NEAR(rms_after(plan, program_of(plan.program.table)), plan.dwell.residual.rms, 1e-3 * spared);
    EXPECT_NEAR(plan.dwell.exact.statistics.rms, plan.dwell.residual.rms, 0.02 * spared);
    EXPECT_LT(plan.dwell.seconds.sum(), 0.9 * whole.dwell.seconds.sum());
    EXPECT_LT(plan.dwell.certificate.residual_rms, 0.5 * spared) << "what the solver was asked for";
    const OutputFolder folder(job.options.out, plan_files());
    const auto summary = nlohmann::json::parse(write_plan(plan, folder, {}).summary);
    EXPECT_EQ(summary["aim"]["fraction"], 0.75);
    EXPECT_NEAR(summary["aim"]["would_remain_rms_nm"].get<double>(), spared, 1e-6 * spared);
    EXPECT_EQ(summary["options"]["fraction"], "0.75");
    EXPECT_NEAR(summary["program"]["residual_rms_nm"].get<double>(), plan.dwell.residual.rms, 0.02 * spared);
    EXPECT_TRUE(summary["limits"].empty()) << summary["limits"];
  }
}

TEST(MakePlan, PlansForTheApertureAlone) {
  for (const char* aperture : {"rect:0,3,6,9.3", "circle:3,6,3.3"}) {
    SmallJob job;
    job.options.aperture = parse_aperture(aperture);
    const PlannedJob plan = plan_job(job.options, {});
    const HeightMap whole = small_map();
    Index expected = 0;
    for (Index i = 0; i < whole.grid.size(); ++i) {
      const Point p = whole.grid.centre(i);
      const bool inside =
          aperture[0] == 'r' ? p.x >= 0 && p.x <= 6 && p.y >= 3 && p.y <= 9.3 : std::hypot(p.x - 3.0, p.y - 6.0) <= 3.3;
      const bool counts = inside && std::isfinite(whole.values[static_cast<std::size_t>(i)]);
      expected += counts;
      EXPECT_EQ(std::isfinite(plan.part().map.values[static_cast<std::size_t>(i)]), counts)
          << aperture << " pixel " << i;
    }
    EXPECT_EQ(plan.part().before.valid_pixels, expected) << aperture;
    EXPECT_EQ(plan.dwell.residual.valid_pixels, expected) << aperture;
    EXPECT_LE(plan.dwell.residual.rms, 0.1 * plan.part().before.rms) << aperture;
  }
}

TEST(MakePlan, FollowsANearestNeighbourPath) {
  SmallJob job;
  job.options.path = parse_path_spec("nearest:cell=1,critical=-inf");
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_EQ(plan.laid.path.kind, "nearest");
  EXPECT_LE(plan.dwell.residual.rms, 0.5 * plan.part().before.rms);
  EXPECT_NEAR(rms_after(plan, program_of(plan.program.table)), plan.dwell.residual.rms, 1e-3 * plan.dwell.residual.rms);
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
  job.options.path = parse_path_spec("file:" + file.string());
  const PlannedJob plan = plan_job(job.options, {});
  ASSERT_EQ(plan.laid.path.size(), 13u * 17u);
  EXPECT_EQ(plan.laid.path.points[17].x, 11.0);
  EXPECT_EQ(plan.laid.path.points[17].y, 2.0);
  EXPECT_EQ(plan.laid.metrics.lifts, 1);
  ASSERT_EQ(plan.job.inputs.size(), 2u);  // map and path; the tool is a formula
  EXPECT_EQ(plan.job.inputs[1].role, "path");
  EXPECT_EQ(plan.job.inputs[1].sha256, sha256_of_file(file));
  EXPECT_LE(plan.dwell.residual.rms, 0.2 * plan.part().before.rms);
}

TEST(MakePlan, SaysWhichInputIsMissing) {
  SmallJob job;
  job.options.path = {};
  expect_input_error([&] { plan_job(job.options, {}); }, {"--path", "raster:pitch=1"});
  job.options.tif.clear();
  expect_input_error([&] { plan_job(job.options, {}); }, {"--tif"});
  job.options.map.clear();
  expect_input_error([&] { plan_job(job.options, {}); }, {"--map"});
}

TEST(MakePlan, StopsWhenAskedAndReportsEveryStage) {
  const SmallJob job;
  std::vector<std::string> lines;
  Progress progress;
  progress.show = [&lines](const std::string& line) { lines.push_back(line); };
  progress.stop = [&lines] { return !lines.empty() && lines.back().starts_with("solve"); };
  EXPECT_THROW(plan_job(job.options, progress), Interrupted);
  ASSERT_GE(lines.size(), 4u);
  EXPECT_EQ(lines[0], "reading the map");
  EXPECT_TRUE(lines[1].starts_with("map: 22 x 30 pixels"));
  EXPECT_TRUE(lines[2].starts_with("path:"));
}

std::map<std::string, std::string> written_files(const JobOptions& options) {
  PlannedJob plan = plan_job(options, {});
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
  const auto& formats = program_formats();
  const auto exports = std::count_if(formats.begin(), formats.end(),
                                     [](const auto& format) { return !format.word.empty() && !format.file.empty(); });
  EXPECT_EQ(one.size() + static_cast<std::size_t>(exports),
            plan_files().others.size() - 8 + plan_files().figures.size() - 3 +
                1);  // no parts, log, rest, tools, machine or uncertainty
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
    job.options.motion = parse_motion(motion);
    PlannedJob plan = plan_job(job.options, {});
    const OutputFolder folder(job.options.out, plan_files());
    const WrittenPlan written = write_plan(plan, folder, {});
    const double expected = plan.dwell.residual.rms;
    EXPECT_NEAR(written.exact.lattice_rms, plan.dwell.residual.rms_about_zero(), 1e-3 * expected) << motion;
    EXPECT_NEAR(written.exact.statistics.rms, expected, 2e-3 * expected + 3.0 * written.exact.standard_error) << motion;
    EXPECT_TRUE(plan.limits().empty()) << motion;
  }
}

TEST(MakePlan, OneAndTwoThreadsAgree) {
  SmallJob job;
  const PlannedJob one = plan_job(job.options, {});
  job.options.threads = 2;
  const PlannedJob two = plan_job(job.options, {});
  EXPECT_EQ(two.part().threads, 2);
  EXPECT_NEAR(two.dwell.residual.rms, one.dwell.residual.rms, 1e-6 * one.dwell.residual.rms);
  EXPECT_NEAR(two.dwell.seconds.sum(), one.dwell.seconds.sum(), 1e-6 * one.dwell.seconds.sum());
  EXPECT_LE((two.dwell.seconds - one.dwell.seconds).norm(), 1e-6 * one.dwell.seconds.norm());
}

}  // namespace
}  // namespace dwell
