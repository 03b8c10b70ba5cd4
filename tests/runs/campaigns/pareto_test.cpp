#include "runs/campaigns/pareto.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>

#include "core/base/number_text.h"
#include "core/base/version.h"
#include "paths/feed/plan_program.h"
#include "runs/campaigns/pareto_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::SmallJob;

TEST(WeightList, ReadsRangesAndLists) {
  const auto range = parse_weight_list("0.001:10:5", "--smoothnesses");
  ASSERT_EQ(range.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(range[k], std::pow(10.0, static_cast<double>(k) - 3.0), 1e-12);
  EXPECT_EQ(range.front(), 0.001);
  EXPECT_EQ(range.back(), 10.0);
  EXPECT_EQ(parse_weight_list("10:0.001:2", "x"), (std::vector<double>{0.001, 10.0}));
  EXPECT_EQ(parse_weight_list("0.1", "x"), (std::vector<double>{0.1}));
  EXPECT_EQ(parse_weight_list("1, 0,0.5,1", "x"), (std::vector<double>{0.0, 0.5, 1.0}));
}

TEST(WeightList, RefusesTheRestNamingOptionTextAndWhatIsAccepted) {
  for (const char* text : {"", "0:1:3", "1:2:1", "1:2:2.5", "1:2", "1:2:3:4", "1:2:1001", "-1", "nan", "inf", "1,,2",
                           "auto", "1:nan:3", "1;2"}) {
    expect_input_error([&] { parse_weight_list(text, "--time-prices"); },
                       {"--time-prices", "'" + std::string(text) + "'", "FROM:TO:COUNT", "list"});
  }
}

/// Straight from the definition, every pair compared.
bool on_front_by_definition(const std::vector<ParetoPoint>& points, std::size_t k) {
  for (const ParetoPoint& other : points) {
    const TradeOff &a = other.trade_off, &b = points[k].trade_off;
    const double left_a = other.exact_rms, left_b = points[k].exact_rms;
    const int worse = (left_a > left_b) + (a.total > b.total) + (a.step_rms > b.step_rms);
    const int better = (left_a < left_b) + (a.total < b.total) + (a.step_rms < b.step_rms);
    if (worse == 0 && better > 0) return false;
  }
  return true;
}

TEST(ParetoFront, IsWhatTheDefinitionSays) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> value(0, seed % 2 == 0 ? 5 : 1000);  // with and without ties
    std::vector<ParetoPoint> points(1 + seed);
    for (ParetoPoint& p : points) {
      p.exact_rms = static_cast<double>(value(random));
      p.trade_off = {0.0, static_cast<double>(value(random)), static_cast<double>(value(random))};
    }
    mark_front(points);
    std::size_t front = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k].on_front, on_front_by_definition(points, k)) << seed << " " << k;
      front += points[k].on_front;
    }
    EXPECT_GE(front, 1u);
  }
}

ParetoRanges small_ranges() { return {{0.01, 0.1, 1.0}, {0.0, 1e-3}}; }

TEST(ParetoSweep, HasEveryPairOnceAndWhatAPlanWithItHas) {
  const SmallJob job;
  const ParetoSweep sweep = sweep_weights(job.options, small_ranges(), {});
  ASSERT_EQ(sweep.points.size(), 6u);
  EXPECT_TRUE(sweep.limits.empty());
  for (std::size_t k = 0; k < 6; ++k) {
    const ParetoPoint& p = sweep.points[k];
    EXPECT_EQ(p.weights, (Weights{small_ranges().smoothnesses[k / 2], small_ranges().time_prices[k % 2]}));
    JobOptions options = job.options;
    options.smoothness = {p.weights.smoothness};
    options.time_price_nm2_per_s = {p.weights.time_price};
    const PlannedJob plan = plan_job(options, {});
    EXPECT_NEAR(p.trade_off.residual_rms, plan.dwell.residual.rms, 1e-9 * plan.dwell.residual.rms);
    EXPECT_EQ(p.trade_off.total, plan.dwell.seconds.sum());
    EXPECT_NEAR(p.exact_rms, plan.dwell.exact.statistics.rms_about_zero(), 0.03 * p.exact_rms);
    EXPECT_EQ(p.trade_off.step_rms, plan.dwell.step_rms);
    EXPECT_EQ(p.solver.operator_applications, plan.dwell.solver.operator_applications + 1);
    EXPECT_EQ(p.on_front, on_front_by_definition(sweep.points, k));
  }
}

TEST(ParetoSweep, StatesTheExactResidualWhereTheLatticeIsWrong) {
  SmallJob job;
  job.options.tif = "disc:slope=4,radius=1.1";  // a rim sharper than the pixels
  job.options.remove = {};
  const ParetoSweep sweep = sweep_weights(job.options, {{1e-6}, {0.0}}, {});
  const ParetoPoint& p = sweep.points[0];
  EXPECT_GT(std::abs(p.exact_rms - p.trade_off.residual_rms), 5.0 * p.standard_error);
  EXPECT_LE(p.standard_error, 0.011 * p.exact_rms);
}

TEST(TravelTimes, AreWhatARunTakesBesidesItsDwell) {
  SmallJob job;
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    job.options.motion = motion;
    const PlannedJob plan = plan_job(job.options, {});
    const TravelTimes travel = travel_times(plan.laid, 10.0, {0.0, job.options.max_feed_mm_per_min});
    EXPECT_EQ(travel.between_stops > 0.0, motion == Motion::Stop);
    const double steps = program_of(plan.program.table).total_seconds();  // of the table: without the way down
    EXPECT_NEAR(steps, plan.dwell.seconds.sum() + travel.between_stops, 1e-6 * steps);
    EXPECT_NEAR(travel.down, 10.0 / (job.options.max_feed_mm_per_min / 60.0), 1e-12);
    EXPECT_EQ(travel.lifted, 0.0);
  }
}

// A stroke on the move begins before its point and ends behind it: what is lifted is from the one to the other.
TEST(TravelTimes, OfLiftsAreThoseOfTheProgram) {
  ToolPath path;
  path.points = {{-4, -4}, {0, -4}, {4, -3}, {-4, 0}, {0, 0.5}, {4, 0}, {-4, 4}, {3, 4}};
  path.lifted = {1, 0, 0, 1, 0, 0, 1, 0};
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    const LaidPath laid = lay_path(path, motion);
    const Program program = program_of(laid.path, std::vector<double>(path.points.size(), 5.0), motion, 5.0);
    const TravelTimes travel = travel_times(laid, 10.0, {0.0, 300.0});
    EXPECT_GT(program.rapid_length, 15.0);
    EXPECT_NEAR(travel.lifted, program.rapid_length / 5.0 + 2 * 10.0 / 5.0, 1e-12);
    EXPECT_NEAR(travel.down, 3 * 10.0 / 5.0, 1e-12);
  }
}

TEST(ParetoSweep, HasRangesOfItsOwn) {
  const SmallJob job;
  const ParetoSweep sweep = sweep_weights(job.options, {}, {});
  EXPECT_EQ(sweep.ranges.smoothnesses.size(), 5u);
  ASSERT_EQ(sweep.ranges.time_prices.size(), 5u);
  EXPECT_EQ(sweep.ranges.time_prices[0], 0.0);
  EXPECT_EQ(sweep.points.size(), 25u);
  // The prices matter: from the first to the last the machine time falls.
  EXPECT_LT(sweep.points[4].trade_off.total, 0.95 * sweep.points[0].trade_off.total);
}

TEST(ParetoSweep, StopsWhenAsked) {
  const SmallJob job;
  std::vector<std::string> lines;
  Progress progress;
  progress.show = [&lines](const std::string& line) { lines.push_back(line); };
  progress.stop = [&lines] { return !lines.empty() && lines.back().starts_with("solve 2 of 6"); };
  EXPECT_THROW(sweep_weights(job.options, small_ranges(), progress), Interrupted);
}

TEST(ParetoSweep, SaysWhereTheSolverDidNotConverge) {
  SmallJob job;
  job.options.max_solve_s = 1e-9;
  const ParetoSweep sweep = sweep_weights(job.options, small_ranges(), {});
  ASSERT_EQ(sweep.limits.size(), 1u);
  EXPECT_TRUE(sweep.limits[0].starts_with("6 of 6 solves did not converge")) << sweep.limits[0];
}

TEST(WritePareto, TableAndJsonSayTheSame) {
  const SmallJob job;
  const ParetoSweep sweep = sweep_weights(job.options, small_ranges(), {});
  const auto json = nlohmann::json::parse(pareto_json_text(sweep));
  EXPECT_EQ(json["version"], version());
  EXPECT_EQ(json["inputs"].size(), 1u);
  EXPECT_EQ(json["options"]["path"], to_string(job.options.path));
  EXPECT_FALSE(json["options"].contains("smoothness"));
  ASSERT_EQ(json["points"].size(), 6u);

  const std::string table = pareto_table_text(sweep);
  EXPECT_TRUE(
      table.starts_with("smoothness,time_price_nm2_per_s,residual_rms_nm,total_s,step_rms_s,objective_nm2,"
                        "operator_applications,status,front,exact_residual_rms_nm,standard_error_nm,run_s\n"));
  std::size_t at = table.find('\n') + 1;
  for (const auto& p : json["points"]) {
    const std::size_t end = table.find('\n', at);
    ASSERT_NE(end, std::string::npos);
    const std::string row = table.substr(at, end - at);
    const std::vector<std::string_view> fields = split(row, ',');
    ASSERT_EQ(fields.size(), 12u) << row;
    std::size_t column = 0;
    for (const char* key : {"smoothness", "time_price_nm2_per_s", "residual_rms_nm", "total_s", "step_rms_s",
                            "objective_nm2", "operator_applications"}) {
      EXPECT_EQ(parse_number(fields[column++]).value(), p[key].get<double>()) << key;
    }
    EXPECT_EQ(fields[7], p["status"].get<std::string>());
    EXPECT_EQ(fields[8], p["front"].get<bool>() ? "yes" : "no");
    column = 9;
    for (const char* key : {"exact_residual_rms_nm", "exact_residual_rms_standard_error_nm", "run_s"}) {
      EXPECT_EQ(parse_number(fields[column++]).value(), p[key].get<double>()) << key;
    }
    at = end + 1;
  }
  EXPECT_EQ(at, table.size());
}

}  // namespace
}  // namespace dwell
