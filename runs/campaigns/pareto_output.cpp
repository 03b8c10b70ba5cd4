#include "runs/campaigns/pareto_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "runs/base/inputs_json.h"
#include "runs/campaigns/pareto_picture.h"
#include "runs/plan/figure_output.h"
#include "runs/plan/options_json.h"

namespace dwell {

std::string pareto_table_text(const ParetoSweep& sweep) {
  std::string text =
      "smoothness,time_price_nm2_per_s,residual_rms_nm,total_s,step_rms_s,objective_nm2,operator_applications,status,"
      "front\n";
  for (const ParetoPoint& p : sweep.points) {
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", p.weights.smoothness, p.weights.time_price,
                        p.trade_off.residual_rms, p.trade_off.total, p.trade_off.step_rms, p.objective,
                        p.solver.operator_applications, to_string(p.solver.status), p.on_front ? "yes" : "no");
  }
  return text;
}

std::string pareto_json_text(const ParetoSweep& sweep) {
  using Json = nlohmann::ordered_json;
  Json points = Json::array();
  for (const ParetoPoint& p : sweep.points) {
    points.push_back({{"smoothness", p.weights.smoothness},
                      {"time_price_nm2_per_s", p.weights.time_price},
                      {"residual_rms_nm", p.trade_off.residual_rms},
                      {"total_s", p.trade_off.total},
                      {"step_rms_s", p.trade_off.step_rms},
                      {"objective_nm2", p.objective},
                      {"operator_applications", p.solver.operator_applications},
                      {"status", to_string(p.solver.status)},
                      {"front", p.on_front}});
  }
  Json options = options_json(sweep.plan);
  for (const char* unused : {"smoothness", "time_price_nm2_per_s", "gcode", "lift_height_mm"}) options.erase(unused);
  const Json summary = {{"schema", 1},
                        {"version", version()},
                        {"points", points},
                        {"wall_s", sweep.seconds},
                        {"before_rms_nm", sweep.plan.before.rms},
                        {"smoothnesses", sweep.ranges.smoothnesses},
                        {"time_prices_nm2_per_s", sweep.ranges.time_prices},
                        {"limits", sweep.limits},
                        {"options", options},
                        {"inputs", inputs_json(sweep.plan.inputs)}};
  return summary.dump(2) + "\n";
}

std::string write_pareto(const ParetoSweep& sweep, const OutputFolder& folder) {
  folder.write("pareto.csv", pareto_table_text(sweep));
  write_figure(folder, sweep.plan.options.figures, "pareto",
               [&](FigureFormat format) { return pareto_picture(sweep, format); });
  std::string json = pareto_json_text(sweep);
  folder.write("pareto.json", json);
  return json;
}

}  // namespace dwell
