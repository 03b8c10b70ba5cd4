#include "runs/reports/plan_summary.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "runs/base/inputs_json.h"
#include "runs/reports/acceptance_report.h"
#include "runs/reports/aim.h"
#include "runs/reports/counted_figures.h"
#include "runs/reports/log_report.h"
#include "runs/reports/machine_report.h"
#include "runs/reports/objective_lines.h"
#include "runs/reports/options_json.h"
#include "runs/reports/plan_blocks.h"
#include "runs/reports/plan_costs.h"
#include "runs/reports/resume_report.h"
#include "runs/reports/tool_sheet.h"
#include "runs/reports/weight_lines.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

Json solve_json(const DwellPlan& plan) {
  const Certificate& c = plan.certificate;
  Json solve = solve_block(plan.solver);
  solve["certificate"] = {{"objective_nm2", c.objective},
                          {"bound_violation_s", c.bound_violation},
                          {"projected_gradient_relative", c.projected_gradient},
                          {"dual_infeasibility_relative", c.dual_infeasibility},
                          {"complementarity_s", c.complementarity},
                          {"lower_bound_nm2", c.lower_bound},
                          {"gap_relative", std::isfinite(c.gap()) ? Json(c.gap()) : Json(nullptr)}};
  return solve;
}

/// How the weights were found: the trials in order.
Json search_json(const WeightTrials& search) {
  Json trials = Json::array();
  for (const TriedWeights& t : search.trials) {
    trials.push_back(trial_block(t.weights, t.trade_off, t.objective, t.operator_applications));
  }
  return {{"criterion", search.criterion},
          {"outcome", search.outcome},
          {"chosen", search.chosen},
          {"front", search.front},
          {"trials", trials}};
}

Json weights_json(const PlannedJob& plan) {
  Json weights = weights_block(plan);
  if (plan.dwell.search) weights["search"] = search_json(*plan.dwell.search);
  return weights;
}

Json feed_json(const FeedSchedule& feed, Motion motion) {
  return {{"motion", to_string(motion)},
          {"min_mm_per_min", fewest_digits(units::mm_per_min(feed.min_speed))},
          {"max_mm_per_min", fewest_digits(units::mm_per_min(feed.max_speed))},
          {"segments_limited", feed.segments_limited},
          {"segments_infeasible", feed.segments_infeasible}};
}

/// What the machine makes of the dwell.
Json motion_json(const MotionPlan& motion, ScheduleKind schedule, double planned) {
  return {{"schedule", to_string(schedule)},
          {"planned_rms_nm", planned},
          {"one_shot_rms_nm", motion.one_shot()},
          {"executed_rms_nm", motion.executed()},
          {"rounds_rms_nm", motion.rounds},
          {"best_round", motion.best},
          {"time_price_nm2_per_s", motion.time_price},
          {"dwell_s", motion.seconds.sum()},
          {"strokes_at_least", motion.at_least},
          {"strokes_too_short", motion.too_short}};
}

/// What the controller's block rate did to the path.
Json blocks_json(const BlockMerging& blocks, double max_per_s, double planned) {
  return {{"max_per_s", max_per_s},   {"before", blocks.before},   {"too_short_before", blocks.short_before},
          {"after", blocks.after},    {"bounded", blocks.bounded}, {"planned_rms_nm_before", blocks.rms_before},
          {"planned_rms_nm", planned}};
}

/// The time at work in which each limit of the machine binds.
Json limits_json(const WrittenPlan& written) {
  const auto seconds = time_at_limits(written.nodes, written.binding);
  const auto of = [&](BindingLimit limit) { return seconds[static_cast<std::size_t>(limit)]; };
  return {{"none_s", of(BindingLimit::None)},
          {"speed_s", of(BindingLimit::Speed)},
          {"acceleration_s", of(BindingLimit::Acceleration)},
          {"rest_s", of(BindingLimit::Rest)},
          {"jerk_s", of(BindingLimit::Jerk)}};
}

/// What the log of an earlier run has taught.
Json learnt_json(const PlannedJob& plan, const WrittenPlan& written) {
  const LogLesson& lesson = *plan.job.lesson;
  const LearntFromRun& run = lesson.run;
  Json json{{"logs", run.learnt.logs},
            {"recorded_rms_nm", run.recorded_rms},
            {"recorded_s", run.recorded_seconds},
            {"expected_s", run.expected_seconds},
            {"late_mean_s", run.late_mean},
            {"late_rms_s", run.late_rms},
            {"removal_rms_nm", run.removal_rms},
            {"late_sha256", written.late_sha256},
            {"removal_sha256", written.learnt_removal_sha256}};
  json["machine_sha256"] = sha256_of_machine(*plan.job.machine);
  json["log"] = log_block(lesson.log, lesson.aligned);
  return json;
}

/// The program as read back, and how feed.csv was compared with it.
Json program_json(const WrittenPlan& written) {
  Json program = program_block(written.program);
  program["sha256"] = written.program_sha256;
  if (written.table_has_same_steps) {
    program["feed_table"] = *written.table_has_same_steps ? "same steps" : "simulated";
  }
  return program;
}

/// The programs besides feed.csv and program.nc.
Json exports_json(const WrittenPlan& written) {
  Json exports = Json::array();
  for (const WrittenExport& e : written.exports) {
    exports.push_back({{"format", e.word},
                       {"file", e.file},
                       {"files", e.files},
                       {"sha256", e.sha256},
                       {"steps", e.steps},
                       {"total_s", e.total_s},
                       {"rms_nm", e.residual.rms}});
  }
  return exports;
}

/// The way from the plan's folder to the current one, from which the names of files are seen. A way and no place: it
/// stays right where both are moved together.
std::string names_from(const PlannedJob& plan) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path folder = fs::weakly_canonical(fs::absolute(plan.job.options.out, unknown), unknown);
  const fs::path here = fs::canonical(fs::current_path(unknown), unknown);
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();  // "plan/" is the folder "plan"
  return with_escaped_bytes(here.lexically_relative(plain).string());
}

}  // namespace

std::string plan_summary_text(const PlannedJob& plan, const WrittenPlan& written) {
  Json summary = json_of_command("plan");
  summary.update({{"map", plan_map_block(plan.job)},
                  {"aim", aim_block(correction_aim(plan.job))},
                  {"tif", plan_tif_block(plan.job)},
                  {"tool", tool_block(tool_sheet(plan.part().tif))},
                  {"path", plan_path_block(plan.laid)},
                  {"weights", weights_json(plan)},
                  {"solve", solve_json(plan.dwell)},
                  {"dwell", dwell_block(plan_dwell_figures(plan.dwell))},
                  {"residual", residual_block(to_string(plan.part().form), plan.dwell.residual)},
                  {"feed", feed_json(plan.program.feed, plan.laid.motion)},
                  {"program", program_json(written)},
                  {"anatomy", plan_anatomy_block(plan, written)},
                  {"surface", surface_block(written.surface)},
                  {"total_s", written.run_seconds},
                  {"lift_s", written.travel.lifted},
                  {"down_s", written.travel.down},
                  {"between_stops_s", written.travel.between_stops},
                  {"warnings", written.warnings},
                  {"limits", written.limits},
                  {"options", options_json(plan.job)},
                  {"names_from", names_from(plan)},
                  {"inputs", inputs_json(plan.job.inputs)}});
  if (plan.resumed) summary["resume"] = resume_block(*plan.resumed);
  if (!written.acceptance.empty()) summary["acceptance"] = acceptance_block(written.acceptance);
  if (const auto counted = counted_figures(plan.job, written.exact.surface))
    summary["counted"] = counted_block(*counted);
  if (plan.job.options.objective.has_slopes()) summary["objective"] = objective_block(plan);
  if (written.uncertainty) summary["uncertainty"] = uncertainty_block(*written.uncertainty);
  if (!written.exports.empty()) summary["exports"] = exports_json(written);
  if (plan.dwell.motion) {
    summary["machine"] = machine_block(*plan.job.machine);
    summary["motion"] =
        motion_json(*plan.dwell.motion, plan.job.options.schedule, plan.dwell.residual.rms_about_zero());
    if (plan.blocks)
      summary["blocks"] = blocks_json(*plan.blocks, plan.job.machine->machine.controller.max_blocks_per_s,
                                      plan.dwell.residual.rms_about_zero());
    if (written.travel.rests.any()) summary["motion"]["lift_rests"] = lift_block(written.travel.rests);
    summary["motion"]["limits"] = limits_json(written);
    if (plan.job.lesson) summary["motion"]["learnt"] = learnt_json(plan, written);
  }
  return json_text(std::move(summary));
}

}  // namespace dwell
