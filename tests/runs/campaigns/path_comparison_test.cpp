#include "runs/campaigns/path_comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>
#include <sstream>

#include "core/base/whole_file.h"
#include "runs/campaigns/path_comparison_output.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/simulation.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::SmallJob;

bool better_or_equal(const ComparedPath& a, const ComparedPath& b) {
  return a.residual_rms <= b.residual_rms && a.mid_rms().value_or(0.0) <= b.mid_rms().value_or(0.0) &&
         a.total_time <= b.total_time;
}

TEST(PathFront, IsWhatTheDefinitionSays) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::vector<ComparedPath> paths(2 + seed % 9);
    for (ComparedPath& p : paths) {
      p.residual_rms = static_cast<double>(random() % 4);
      if (seed % 3 != 0) p.residual_ripple.emplace().rms = static_cast<double>(random() % 4);
      p.total_time = static_cast<double>(random() % 4);
      if (random() % 5 == 0) p.failure = "none";
      p.solver.status = random() % 5 == 0 ? SolverStatus::TimeLimit : SolverStatus::Settled;
    }
    mark_front(paths);
    for (const ComparedPath& p : paths) {
      const bool dominated = std::any_of(paths.begin(), paths.end(), [&](const ComparedPath& other) {
        return other.whole() && better_or_equal(other, p) && !better_or_equal(p, other);
      });
      EXPECT_EQ(p.on_front, p.failure.empty() && p.solver.status == SolverStatus::Settled && !dominated) << seed;
    }
  }
}

TEST(DefaultPitch, IsAQuarterOfTheFwhmToTwoDigits) {
  EXPECT_DOUBLE_EQ(default_pitch(gaussian_removal(1.0, 4.0, 5.0)), 1.0);
  EXPECT_DOUBLE_EQ(default_pitch(gaussian_removal(1.0, 2.5, 5.0)), 0.62);
  EXPECT_DOUBLE_EQ(default_pitch(gaussian_removal(1.0, 63.9, 100.0)), 15.0);
}

TEST(PathComparison, SaysOfEachPathWhatItsOwnProgramDoes) {
  SmallJob job;
  const std::filesystem::path out = job.folder.path() / "paths";
  job.options.out = out.string();
  OutputFolder folder(out, path_comparison_files());
  const PathComparison comparison =
      compare_paths(job.options, "raster,raster:pitch=2,angle=90,nearest:critical=-inf", {}, folder, {});
  const std::string json = write_path_comparison(comparison, folder);
  folder.commit();
  EXPECT_EQ(comparison.pitch, 0.62);
  ASSERT_EQ(comparison.paths.size(), 3u);
  EXPECT_TRUE(std::any_of(comparison.paths.begin(), comparison.paths.end(), [](const auto& p) { return p.on_front; }));
  EXPECT_LT(comparison.paths[0].residual_rms, comparison.paths[1].residual_rms);  // the finer raster leaves less
  for (const ComparedPath& p : comparison.paths) {
    EXPECT_EQ(p.failure, "");
    const Simulation again = simulate_file(out / p.listed.name / "program.nc", {}, job.options, {});
    EXPECT_NEAR(again.after.statistics.rms, p.residual_rms, 1e-9 * p.residual_rms) << p.listed.name;
    EXPECT_NEAR(again.program.run_seconds(), p.total_time, 1e-6 * p.total_time);  // at the fastest feed, rounded down
    EXPECT_NEAR(again.program.rapid_seconds(), p.lift_time, 1e-6 * p.lift_time);
    EXPECT_TRUE(p.mid_rms() && *p.mid_rms() > 0.0 && *p.mid_rms() <= p.residual_rms * 1.5);
    EXPECT_LE(p.tree_length, p.metrics.point_length * (1.0 + 1e-12));
    const auto summary = nlohmann::json::parse(read_whole_file(out / p.listed.name / "summary.json"));
    EXPECT_EQ(summary["options"]["path"], p.listed.text);
  }
  // Within 0.62 mm of a raster of 0.62 mm everything lies, of one of 2 mm about 1.24 mm of every 2.
  EXPECT_EQ(comparison.paths[0].coverage, 1.0);
  EXPECT_NEAR(comparison.paths[1].coverage, 0.62, 0.12);
  // Lifted moves cost the way there, up and down at maximum feed: 3000 mm/min, 10 mm; ...
  const ComparedPath& nearest = comparison.paths[2];
  EXPECT_NEAR(nearest.lift_time,
              (nearest.metrics.lifted_length + 10.0 * static_cast<double>(nearest.metrics.lifts)) / 50.0, 1e-9);
  // ... of which the way down is in the program already, with the one to the first point.
  EXPECT_NEAR(nearest.total_time - nearest.lift_time - nearest.dwell_total,
              10.0 * static_cast<double>(nearest.metrics.lifts + 1) / 50.0, 1e-3);
  const auto parsed = nlohmann::json::parse(json);
  EXPECT_EQ(parsed["paths"][1]["spec"], "raster:pitch=2,angle=90");
  EXPECT_EQ(parsed["paths"][0]["program"]["residual_rms_nm"], comparison.paths[0].residual_rms);
  EXPECT_FALSE(parsed["options"].contains("path"));
  EXPECT_NO_THROW(OutputFolder(out, path_comparison_files()));  // an earlier comparison may be replaced
  expect_input_error([&] { OutputFolder plan(out, plan_files()); }, {"not an earlier plan"});
  job.folder.file("paths/raster/holiday.jpg", "x");
  expect_input_error([&] { OutputFolder(out, path_comparison_files()); }, {"'raster'", "holiday.jpg"});
}

TEST(PathComparison, GoesOnWhereAPathCannotBePlanned) {
  SmallJob job;
  OutputFolder folder(job.options.out, path_comparison_files());
  const PathComparison comparison = compare_paths(job.options, "nearest:critical=1e9;raster", 2.0, folder, {});
  EXPECT_NE(comparison.paths[0].failure, "");
  EXPECT_FALSE(comparison.paths[0].on_front);
  EXPECT_EQ(comparison.paths[1].failure, "");
  EXPECT_TRUE(comparison.paths[1].on_front);
  ASSERT_EQ(comparison.limits.size(), 1u);
  EXPECT_NE(comparison.limits[0].find("nearest: no plan: "), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path("nearest")));
  // Both tables have a line for it, with as many fields as the others.
  std::istringstream lines(path_table_text(comparison));
  for (std::string line; std::getline(lines, line);) {
    const std::string bare = line.substr(0, line.find('"'));
    if (bare != line) continue;  // a comma in quotes is none
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 30) << line;
  }
  EXPECT_NE(path_comparison_text(comparison).find("nearest: no plan"), std::string::npos);
  expect_input_error([&] { compare_paths(job.options, "nearest:critical=1e9", {}, folder, {}); },
                     {"--paths: none can be planned"});
}

TEST(PathComparison, StopsWhenAsked) {
  SmallJob job;
  OutputFolder folder(job.options.out, path_comparison_files());
  Progress progress;
  progress.stop = [] { return true; };
  EXPECT_THROW(compare_paths(job.options, "raster", {}, folder, progress), Interrupted);
}

}  // namespace
}  // namespace dwell
