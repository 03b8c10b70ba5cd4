#include "runs/campaigns/joint_plan_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/inputs_json.h"
#include "runs/reports/acceptance_report.h"
#include "runs/reports/map_line.h"
#include "runs/reports/options_json.h"
#include "runs/reports/plan_blocks.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

std::string names_of(const JointPlan& plan, const std::vector<std::size_t>& tools) {
  std::string text;
  for (const std::size_t k : tools) text += (text.empty() ? "" : " + ") + plan.names[k];
  return text;
}

bool within_total(const JointPlan& plan) { return plan.job.options.time_price_nm2_per_s.kind == GoalKind::TotalAtMost; }

/// What the residual is of: the heights, or what an objective with slopes sees.
std::string residual_words(const JointPlan& plan) {
  const FitObjective& objective = plan.job.options.objective;
  return objective.has_slopes() ? fmt::format("RMS of {} [nm]", objective.slope_share < 1.0 ? "both" : "slopes")
                                : "residual RMS [nm]";
}

/// A tried set that differs from the chosen one by this tool alone; nothing if none was tried.
const TriedTools* differs_by(const JointPlan& plan, std::size_t tool) {
  std::vector<std::size_t> other = plan.choice.set().tools;
  const auto place = std::find(other.begin(), other.end(), tool);
  if (place != other.end()) {
    other.erase(place);
  } else {
    other.insert(std::upper_bound(other.begin(), other.end(), tool), tool);
  }
  for (const TriedTools& tried : plan.choice.tried) {
    if (tried.tools == other) return &tried;
  }
  return nullptr;
}

std::string change_words(double from, double to) {
  return fmt::format("{} {}", duration_text(std::abs(to - from)), to >= from ? "more" : "less");
}

/// Whether a tool pays, with what it is against the same without or with it.
std::string verdict_line(const JointPlan& plan, std::size_t tool) {
  const TriedTools& now = plan.choice.set();
  const TriedTools* other = differs_by(plan, tool);
  const bool works = std::find(now.tools.begin(), now.tools.end(), tool) != now.tools.end();
  const std::string head = fmt::format("          {} {}", plan.names[tool], works ? "pays" : "does not pay");
  if (!other) {
    return head + (works                ? ": no other set was tried\n"
                   : within_total(plan) ? ": no set with it is better, or fits into the total\n"
                                        : ": worse than the others in every set tried\n");
  }
  return fmt::format("{}: {} it {:.4g} nm RMS{} would be left in {} of machine time, {}\n", head,
                     works ? "without" : "with", other->residual_rms,
                     plan.job.options.objective.has_slopes() ? " of the objective" : "",
                     duration_text(other->seconds + other->change_over),
                     change_words(now.seconds + now.change_over, other->seconds + other->change_over));
}

std::string price_words(const JointPlan& plan) {
  if (plan.choice.worth) return ", by the rules of a plan, with all tools";
  if (!within_total(plan)) return "";
  return fmt::format(", the least at which dwell and change-over take no more than {:.6g} s",
                     plan.job.options.time_price_nm2_per_s.value);
}

std::string tried_lines(const JointPlan& plan) {
  std::size_t widest = 5;
  for (const TriedTools& tried : plan.choice.tried) widest = std::max(widest, names_of(plan, tried.tools).size());
  std::string text = fmt::format("  {:<{}} {:>17} {:>11} {:>15} {:>13}\n", "tools", widest, residual_words(plan),
                                 "dwell [s]", "change-over [s]", "cost [nm^2]");
  for (std::size_t k = 0; k < plan.choice.tried.size(); ++k) {
    const TriedTools& tried = plan.choice.tried[k];
    text += fmt::format("{} {:<{}} {:>17.4g} {:>11.2f} {:>15.6g} {:>13.5g}\n", k == plan.choice.chosen ? '*' : ' ',
                        names_of(plan, tried.tools), widest, tried.residual_rms, tried.seconds, tried.change_over,
                        tried.cost);
  }
  return text +
         "  Residual on the solver's lattices, before the machine's motion; cost: half the mean square that is left, "
         "smoothness" +
         (within_total(plan) ? ".\n" : ", and time at its price.\n");
}

Json set_json(const JointPlan& plan, const TriedTools& tried, bool chosen) {
  Json tools = Json::array();
  for (const std::size_t k : tried.tools) tools.push_back(plan.names[k]);
  return {{"tools", tools},
          {"time_price_nm2_per_s", tried.price},
          {"residual_rms_nm", tried.residual_rms},
          {"total_s", tried.seconds},
          {"change_over_s", tried.change_over},
          {"cost_nm2", tried.cost},
          {"status", to_string(tried.status)},
          {"gap_relative", finite_or_null(tried.gap)},
          {"chosen", chosen}};
}

Json run_json(const JointPlan& plan, const ToolRun& run) {
  const std::string removed = to_string(plan.job.part->form);
  return {{"tool", plan.names[run.tool]},
          {"folder", run.folder},
          {"price", run.price},
          {"change_over_s", run.change_over},
          {"total_s", run.dwell},
          {"run_s", run.seconds},
          {"before", residual_block(removed, run.before)},
          {"residual", residual_block(removed, run.left)},
          {"limits", run.limits},
          {"warnings", run.warnings}};
}

std::string joint_plan_json(const JointPlan& plan) {
  Json tools = Json::array(), sets = Json::array(), runs = Json::array();
  for (std::size_t k = 0; k < plan.names.size(); ++k) {
    tools.push_back({{"name", plan.names[k]},
                     {"tif", plan.tif[k]},
                     {"fwhm_mm", plan.fwhm[k]},
                     {"smoothness", plan.smoothnesses[k]},
                     {"price", plan.prices[k]},
                     {"change_over_s", plan.change_overs[k]}});
  }
  for (std::size_t k = 0; k < plan.choice.tried.size(); ++k)
    sets.push_back(set_json(plan, plan.choice.tried[k], k == plan.choice.chosen));
  for (const ToolRun& run : plan.runs) runs.push_back(run_json(plan, run));
  Json summary = json_of_command("plan --tool");
  summary.update({{"map", plan_map_block(plan.job)},
                  {"tools", tools},
                  {"time_price_nm2_per_s", plan.choice.set().price},
                  {"sets", sets},
                  {"solve", solve_block(plan.choice.dwell.solver)},
                  {"operator_applications", plan.choice.applications},
                  {"wall_s", plan.choice.seconds},
                  {"runs", runs},
                  {"run_s", plan.seconds()},
                  {"change_over_s", plan.change_over()}});
  if (!plan.acceptance.empty()) summary["acceptance"] = acceptance_block(plan.acceptance);
  summary.update(
      {{"limits", plan.limits}, {"options", options_json(plan.job)}, {"inputs", inputs_json(plan.job.inputs)}});
  return json_text(std::move(summary));
}

}  // namespace

std::string joint_plan_text(const JointPlan& plan) {
  const Part& part = *plan.job.part;
  std::string text = map_line(part.map.grid, part.before.valid_pixels);
  text += fmt::format("before    {} ({} removed)\n", in_words(part.before), to_string(part.form));
  for (std::size_t k = 0; k < plan.names.size(); ++k) {
    text += fmt::format("{}{}: {}, FWHM {:.4g} mm, smoothness {:.4g}, {:.4g} of the price, change-over {:.6g} s\n",
                        k == 0 ? "tools     " : "          ", plan.names[k], plan.tif[k], plan.fwhm[k],
                        plan.smoothnesses[k], plan.prices[k], plan.change_overs[k]);
  }
  const SolverSummary& solver = plan.choice.dwell.solver;
  text += fmt::format("price     {:.4g} nm^2/s{}\n", plan.choice.set().price, price_words(plan));
  text += fmt::format("solver    {}: {}, {}, {:.2f} s for {}\n", to_string(solver.kind), to_string(solver.status),
                      counted(plan.choice.applications, "operator application"), plan.choice.seconds,
                      counted(plan.choice.tried.size(), "set of tools", "sets of tools"));
  text += tried_lines(plan) + "choice    " + names_of(plan, plan.choice.set().tools) + "\n";
  for (std::size_t k = 0; k < plan.names.size(); ++k) text += verdict_line(plan, k);
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const ToolRun& run = plan.runs[i];
    text +=
        fmt::format("{}{}: {} -> {}, dwell {:.2f} s, program {}\n", i == 0 ? "runs      " : "          ", run.folder,
                    rms_in_words(run.before), rms_in_words(run.left), run.dwell, duration_text(run.seconds));
  }
  const MapStatistics& left = plan.runs.back().left;
  text +=
      fmt::format("program   {} after all programs, as read back and simulated one after the other\n", in_words(left));
  text += verdict_lines(plan.acceptance);
  text += fmt::format("time      {} with {} of change-over\n", duration_text(plan.seconds() + plan.change_over()),
                      duration_text(plan.change_over()));
  for (const ToolRun& run : plan.runs) {
    for (const std::string& warning : run.warnings) text += fmt::format("warning   {}: {}\n", run.folder, warning);
  }
  return text;
}

std::string write_joint_plan(const JointPlan& plan, const OutputFolder& folder) {
  std::string json = joint_plan_json(plan);
  folder.write("tools.json", json);
  return json;
}

}  // namespace dwell
