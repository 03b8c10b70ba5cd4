#include "runs/campaigns/pareto_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

#include "runs/base/inputs_json.h"
#include "runs/campaigns/pareto_picture.h"
#include "runs/reports/aim.h"
#include "runs/reports/figure_output.h"
#include "runs/reports/options_json.h"
#include "runs/reports/plan_blocks.h"
#include "runs/reports/tool_sheet.h"

namespace dwell {

std::string pareto_table_text(const ParetoSweep& sweep) {
  std::string text =
      "smoothness,time_price_nm2_per_s,residual_rms_nm,total_s,step_rms_s,objective_nm2,operator_applications,status,"
      "front,exact_residual_rms_nm,standard_error_nm,run_s\n";
  for (const ParetoPoint& p : sweep.points) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", p.weights.smoothness, p.weights.time_price,
                        p.trade_off.residual_rms, p.trade_off.total, p.trade_off.step_rms, p.objective,
                        p.solver.operator_applications, to_string(p.solver.status), p.on_front ? "yes" : "no",
                        p.exact_rms, p.standard_error, p.trade_off.total + sweep.travel.total());
  }
  return text;
}

std::string pareto_json_text(const ParetoSweep& sweep) {
  using Json = nlohmann::ordered_json;
  Json points = Json::array();
  for (const ParetoPoint& p : sweep.points) {
    Json point = trial_block(p.weights, p.trade_off, p.objective, p.solver.operator_applications);
    point["status"] = to_string(p.solver.status);
    point["front"] = p.on_front;
    point["exact_residual_rms_nm"] = p.exact_rms;
    point["exact_residual_rms_standard_error_nm"] = p.standard_error;
    point["run_s"] = p.trade_off.total + sweep.travel.total();
    points.push_back(std::move(point));
  }
  Json options = options_json(sweep.job);
  for (const char* unused : {"smoothness", "time_price_nm2_per_s", "time_worth", "certify", "accept", "gcode",
                             "machine", "schedule", "rounds", "export", "template", "log", "log_plan", "log_columns",
                             "log_period_s", "log_tolerance_mm", "uncertainty", "robust_plan"})
    options.erase(unused);
  Json summary = json_of_command("pareto");
  summary.update({{"map", plan_map_block(sweep.job)},
                  {"aim", aim_block(correction_aim(sweep.job))},
                  {"tif", plan_tif_block(sweep.job)},
                  {"tool", tool_block(tool_sheet(sweep.job.part->tif))},
                  {"path", plan_path_block(sweep.laid)},
                  {"points", points},
                  {"wall_s", sweep.seconds},
                  {"smoothnesses", sweep.ranges.smoothnesses},
                  {"time_prices_nm2_per_s", sweep.ranges.time_prices},
                  {"limits", sweep.limits},
                  {"options", options},
                  {"inputs", inputs_json(sweep.job.inputs)}});
  return json_text(std::move(summary));
}

std::string write_pareto(const ParetoSweep& sweep, const OutputFolder& folder) {
  folder.write("pareto.csv", pareto_table_text(sweep));
  write_figure(folder, sweep.job.options.figures, "pareto",
               [&](FigureFormat format) { return pareto_picture(sweep, format); });
  std::string json = pareto_json_text(sweep);
  folder.write("pareto.json", json);
  return json;
}

}  // namespace dwell
