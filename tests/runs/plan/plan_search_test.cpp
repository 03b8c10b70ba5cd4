#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "runs/job/planned_job.h"
#include "runs/plan/plan_problem.h"
#include "runs/reports/front_lines.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::SmallJob;

/// Figures of the plan that the weights given as numbers make.
PlannedJob plan_with(const SmallJob& job, const Weights& weights) {
  JobOptions options = job.options;
  options.smoothness = {weights.smoothness};
  options.time_price_nm2_per_s = {weights.time_price};
  return plan_job(options, {});
}

TEST(PlanSearch, NoneWhereBothWeightsAreNumbers) {
  const SmallJob job;
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_FALSE(plan.dwell.search.has_value());
  EXPECT_EQ(plan.dwell.weights, (Weights{0.01, 0.0}));
}

TEST(PlanSearch, ReportedFiguresAreThoseOfTheDwell) {
  const SmallJob job;
  const PlannedJob plan = plan_with(job, {0.05, 1e-4});
  const PathSmoothness d = path_smoothness(plan.laid.path, plan.laid.strokes);
  double sum = 0.0;
  Index links = 0;
  for (Index j = 1; j < plan.dwell.seconds.size(); ++j) {
    if (!d.linked(j)) continue;
    sum += std::pow(d.scale(j) * plan.dwell.seconds[j] - d.scale(j - 1) * plan.dwell.seconds[j - 1], 2);
    ++links;
  }
  EXPECT_NEAR(plan.dwell.step_rms, std::sqrt(sum / static_cast<double>(links)), 1e-12 * plan.dwell.step_rms);
  EXPECT_EQ(plan.dwell.weights, (Weights{0.05, 1e-4}));
}

TEST(PlanSearch, AResidualTargetIsOfAllThatRemainsWhereAFractionIsRemoved) {
  SmallJob job;
  job.options.fraction = 0.75;
  const double rough = plan_with(job, {1e-4, 0.0}).dwell.residual.rms,
               smooth = plan_with(job, {10.0, 0.0}).dwell.residual.rms;
  ASSERT_LT(rough, smooth);
  const double target = std::sqrt(rough * smooth);
  job.options.smoothness = {target, GoalKind::ResidualAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_LE(plan.dwell.residual.rms_about_zero(), target * (1.0 + 1e-6));
  EXPECT_GE(plan.dwell.residual.rms_about_zero(), 0.97 * target);
  const TriedWeights& chosen = plan.dwell.search->trials.at(plan.dwell.search->chosen);
  EXPECT_NEAR(chosen.trade_off.residual_rms, plan.dwell.residual.rms_about_zero(), 1e-6 * target);
}

TEST(PlanSearch, AStepTargetIsMetByThePlan) {
  SmallJob job;
  const double rough = plan_with(job, {1e-4, 0.0}).dwell.step_rms, smooth = plan_with(job, {1.0, 0.0}).dwell.step_rms;
  ASSERT_LT(smooth, 0.9 * rough);
  job.options.smoothness = {std::sqrt(rough * smooth), GoalKind::StepAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_LE(plan.dwell.step_rms, job.options.smoothness.value);
  EXPECT_GE(plan.dwell.step_rms, 0.97 * job.options.smoothness.value);
  EXPECT_GT(plan.dwell.weights.smoothness, 1e-4);
  EXPECT_LT(plan.dwell.weights.smoothness, 1.0);
  EXPECT_EQ(plan.dwell.weights.time_price, 0.0);
}

TEST(PlanSearch, ATotalTargetIsMetByThePlan) {
  SmallJob job;
  const double free = plan_job(job.options).dwell.seconds.sum();
  job.options.time_price_nm2_per_s = {0.9 * free, GoalKind::TotalAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_LE(plan.dwell.seconds.sum(), 0.9 * free);
  EXPECT_GE(plan.dwell.seconds.sum(), 0.95 * 0.9 * free);  // from one price to the next the solver's total jumps by 3 %
  EXPECT_GT(plan.dwell.weights.time_price, 0.0);
  EXPECT_EQ(plan.dwell.weights.smoothness, 0.01);
}

TEST(PlanSearch, AResidualTargetIsMetByEitherWeight) {
  const SmallJob plain;
  const double best = plan_job(plain.options).dwell.residual.rms;
  for (const bool smooth : {true, false}) {
    SmallJob job;
    (smooth ? job.options.smoothness : job.options.time_price_nm2_per_s) = {2.0 * best, GoalKind::ResidualAtMost};
    const PlannedJob plan = plan_job(job.options, {});
    EXPECT_TRUE(plan.limits().empty());
    EXPECT_LE(plan.dwell.residual.rms, 2.0 * best * (1.0 + 1e-9)) << smooth;
    // On so small a job the solver's own noise steers the last solves of the search.
    EXPECT_GE(plan.dwell.residual.rms, 1.5 * best) << smooth;
  }
}

TEST(PlanSearch, TheWeightsFoundGivenAsNumbersMakeTheSamePlan) {
  SmallJob job;
  job.options.smoothness = {0.0, GoalKind::Corner};
  const PlannedJob found = plan_job(job.options, {});
  const PlannedJob given = plan_with(job, found.dwell.weights);
  EXPECT_EQ(found.dwell.seconds, given.dwell.seconds);
  EXPECT_EQ(found.dwell.residual.rms, given.dwell.residual.rms);
  EXPECT_GT(found.dwell.weights.smoothness, 1e-3);
  EXPECT_LT(found.dwell.weights.smoothness, 10.0);
}

TEST(PlanSearch, StartsOtherSolversFromADwellFoundBefore) {
  SmallJob job;
  job.options.solver = SolverKind::ProjectedCg;
  const Job prepared = load_job(job.options);
  const LaidPath laid = lay_job_path(prepared).laid;
  PlanProblem problem(*prepared.part, laid, prepared.part->kernel, dwell_options(job.options));
  const WeightedDwell cold = problem.solve({0.01, 0.0}, {}, 60.0, "solve", {});
  const WeightedDwell warm = problem.solve({0.01, 0.0}, cold.dwell, 60.0, "solve", {});
  EXPECT_LT(warm.solver.operator_applications, cold.solver.operator_applications);
  job.options.time_price_nm2_per_s = {0.95 * cold.dwell.sum(), GoalKind::TotalAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_LE(plan.dwell.seconds.sum(), 0.95 * cold.dwell.sum());
}

TEST(PlanSearch, CountsTheWorkOfEverySolve) {
  SmallJob job;
  job.options.smoothness = {0.0, GoalKind::Corner};
  const PlannedJob plan = plan_job(job.options, {});
  long sum = 0;
  for (const TriedWeights& t : plan.dwell.search->trials) sum += t.operator_applications;
  EXPECT_EQ(plan.dwell.solver.operator_applications, sum);
  EXPECT_GE(plan.dwell.search->trials.size(), 7u);
  EXPECT_LE(plan.dwell.search->trials.size(), 20u);
  const TriedWeights& chosen = plan.dwell.search->trials[plan.dwell.search->chosen];
  EXPECT_EQ(chosen.weights, plan.dwell.weights);
  EXPECT_EQ(chosen.trade_off.total, plan.dwell.seconds.sum());
  EXPECT_NEAR(chosen.trade_off.residual_rms, plan.dwell.residual.rms, 1e-9 * plan.dwell.residual.rms);
  EXPECT_NEAR(chosen.objective, plan.dwell.certificate.objective, 1e-6 * plan.dwell.certificate.objective);
}

TEST(PlanSearch, ATargetOutOfReachIsSaidAndTheNearestPlanMade) {
  SmallJob job;
  job.options.time_price_nm2_per_s = {1e-6, GoalKind::ResidualAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  ASSERT_EQ(plan.limits().size(), 1u);
  for (const char* part : {"--time-price 'residual<=1e-06'", "not met", "residual RMS", " nm", "time price 0 nm^2/s"}) {
    EXPECT_NE(plan.limits()[0].find(part), std::string::npos) << part << " in: " << plan.limits()[0];
  }
  EXPECT_EQ(plan.dwell.weights.time_price, 0.0);
  EXPECT_LE(plan.dwell.residual.rms, 0.1 * plan.part().before.rms);
}

/// Whether a sentence has all of the words.
bool has_all(const std::string& text, std::initializer_list<std::string> words) {
  return std::all_of(words.begin(), words.end(),
                     [&text](const std::string& word) { return text.find(word) != std::string::npos; });
}

TEST(PlanSearch, AStepAndAResidualAreMetTogetherByTheShortestRunThatDoes) {
  // The step needs a smoothness beyond 100, where the search for a single target used to end.
  SmallJob job;
  const DwellPlan known = plan_with(job, {400.0, 1e-3}).dwell;
  job.options.smoothness = {1.02 * known.step_rms, GoalKind::StepAtMost};
  job.options.time_price_nm2_per_s = {1.02 * known.residual.rms, GoalKind::ResidualAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty()) << plan.limits()[0];
  EXPECT_EQ(plan.dwell.search->outcome, "met");
  EXPECT_TRUE(plan.dwell.search->front.empty());
  EXPECT_LE(plan.dwell.step_rms, job.options.smoothness.value);
  EXPECT_LE(plan.dwell.residual.rms, job.options.time_price_nm2_per_s.value);
  EXPECT_LE(plan.dwell.seconds.sum(), 1.02 * known.seconds.sum());
  EXPECT_GT(plan.dwell.weights.smoothness, 100.0);
}

TEST(PlanSearch, AStepBeyondTheOrdinaryRangeWidensIt) {
  SmallJob job;
  job.options.smoothness = {plan_with(job, {1000.0, 0.0}).dwell.step_rms, GoalKind::StepAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_TRUE(plan.limits().empty());
  EXPECT_NEAR(plan.dwell.weights.smoothness, 1000.0, 50.0);
}

TEST(PlanSearch, AConflictIsSaidWithTheFrontAndTheNearestPlanOfTheTable) {
  SmallJob job;
  const DwellPlan known = plan_with(job, {10.0, 0.0}).dwell;  // on the front of step and residual
  job.options.smoothness = {0.8 * known.step_rms, GoalKind::StepAtMost};
  job.options.time_price_nm2_per_s = {0.8 * known.residual.rms, GoalKind::ResidualAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  const WeightTrials& search = *plan.dwell.search;
  EXPECT_EQ(search.outcome, "conflict");
  ASSERT_EQ(plan.limits().size(), 1u);
  EXPECT_TRUE(has_all(plan.limits()[0], {"--smoothness 'step<=", "--time-price 'residual<=", "are in conflict",
                                         fmt::format("{} solves", search.trials.size()),
                                         fmt::format("step RMS {:.6g} s", plan.dwell.step_rms),
                                         fmt::format("residual RMS {:.6g} nm", plan.dwell.residual.rms)}))
      << plan.limits()[0];
  const auto worst = [&](const TriedWeights& t) {
    return std::max(target_excess(job.options.smoothness, t.trade_off),
                    target_excess(job.options.time_price_nm2_per_s, t.trade_off));
  };
  for (const TriedWeights& t : search.trials) EXPECT_GE(worst(t), worst(search.trials[search.chosen]));
  EXPECT_GT(worst(search.trials[search.chosen]), 0.0);
  ASSERT_GE(search.front.size(), 3u);
  EXPECT_LE(search.trials[search.front.front()].trade_off.step_rms, job.options.smoothness.value);
  EXPECT_LE(search.trials[search.front.back()].trade_off.residual_rms, job.options.time_price_nm2_per_s.value);
  const std::string lines = front_lines(search, job.options.smoothness, job.options.time_price_nm2_per_s);
  EXPECT_TRUE(has_all(lines, {"front     step RMS ", " nm (smoothness ", "time price 0 nm^2/s), this plan\n"}))
      << lines;
  EXPECT_LE(std::count(lines.begin(), lines.end(), '\n'), 7);
}

TEST(PlanSearch, AResidualThatNothingMeetsIsNoConflict) {
  SmallJob job;
  job.options.smoothness = {0.01, GoalKind::StepAtMost};
  job.options.time_price_nm2_per_s = {1e-6, GoalKind::ResidualAtMost};
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_EQ(plan.dwell.search->outcome, "missed");
  ASSERT_FALSE(plan.limits().empty());
  const auto least = std::min_element(
      plan.dwell.search->trials.begin(), plan.dwell.search->trials.end(),
      [](const auto& a, const auto& b) { return a.trade_off.residual_rms < b.trade_off.residual_rms; });
  EXPECT_TRUE(has_all(plan.limits().back(), {"--time-price 'residual<=1e-06' is not met", "the plan is the nearest",
                                             fmt::format("residual RMS {:.6g} nm", least->trade_off.residual_rms)}))
      << plan.limits().back();
  for (const std::string& limit : plan.limits()) EXPECT_EQ(limit.find("conflict"), std::string::npos) << limit;
}

TEST(PlanSearch, ATimeLimitEndsTheSearchWithThePlanItHas) {
  SmallJob job;
  job.options.smoothness = {0.0, GoalKind::Corner};
  job.options.max_solve_s = 1e-9;
  const PlannedJob plan = plan_job(job.options, {});
  EXPECT_EQ(plan.dwell.search->trials.size(), 1u);
  const std::vector<std::string> limits = plan.limits();
  const auto said = [&limits](const char* part) {
    return std::any_of(limits.begin(), limits.end(),
                       [&](const std::string& limit) { return limit.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(said("search of the weights ended after 1 solve"));
  EXPECT_TRUE(said("--max-solve is 1e-09 s"));
}

TEST(PlanSearch, StopsBetweenAndWithinItsSolvesAndReportsEach) {
  for (const char* at : {"search 2: ", "iteration"}) {
    SmallJob job;
    job.options.smoothness = {0.0, GoalKind::Corner};
    std::vector<std::string> lines;
    Progress progress;
    progress.show = [&lines](const std::string& line) { lines.push_back(line); };
    progress.stop = [&] { return !lines.empty() && lines.back().find(at) != std::string::npos; };
    EXPECT_THROW(plan_job(job.options, progress), Interrupted) << at;
  }
  SmallJob job;
  job.options.smoothness = {0.0, GoalKind::Corner};
  std::size_t reported = 0;
  Progress progress;
  progress.show = [&](const std::string& line) {
    reported += line.starts_with("search ") && line.find(" s RMS") != std::string::npos;
  };
  EXPECT_EQ(plan_job(job.options, progress).dwell.search->trials.size(), reported);
}

TEST(PlanSearch, TwoResidualTargetsAreRefused) {
  SmallJob job;
  job.options.smoothness = {0.2, GoalKind::ResidualAtMost};
  job.options.time_price_nm2_per_s = {0.1, GoalKind::ResidualAtMost};
  expect_input_error([&] { plan_job(job.options, {}); },
                     {"`smoothness` 'residual<=0.2'", "`time price` 'residual<=0.1'", "step<=S", "total<=S"});
}

TEST(WritePlan, SearchIsInTheSummaryAndInItsOwnTable) {
  SmallJob job;
  job.options.smoothness = {0.0, GoalKind::Corner};
  const PlannedJob plan = plan_job(job.options, {});
  const OutputFolder folder(job.options.out, plan_files());
  const auto summary = nlohmann::json::parse(write_plan(plan, folder, {}).summary);
  const auto& weights = summary.at("weights");
  EXPECT_EQ(weights.at("smoothness"), plan.dwell.weights.smoothness);
  EXPECT_EQ(weights.at("time_price_nm2_per_s"), 0.0);
  EXPECT_EQ(weights.at("search").at("trials").size(), plan.dwell.search->trials.size());
  EXPECT_EQ(weights["search"]["trials"][plan.dwell.search->chosen]["smoothness"], plan.dwell.weights.smoothness);
  EXPECT_NE(weights["search"]["criterion"].get<std::string>().find("corner"), std::string::npos);
  EXPECT_EQ(weights["search"]["outcome"], "met");
  EXPECT_TRUE(weights["search"]["front"].empty());
  EXPECT_EQ(summary["options"]["smoothness"], "corner");

  const std::string table = write_trials(*plan.dwell.search);
  EXPECT_TRUE(
      table.starts_with("smoothness,time_price_nm2_per_s,residual_rms_nm,total_s,step_rms_s,objective_nm2,"
                        "operator_applications,chosen,front\n"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')),
            plan.dwell.search->trials.size() + 1);
  std::size_t chosen = 0;
  for (std::size_t at = table.find(",1,0\n"); at != std::string::npos; at = table.find(",1,0\n", at + 1)) ++chosen;
  EXPECT_EQ(chosen, 1u);
}

}  // namespace
}  // namespace dwell
