#include "runs/figure/store/run_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/step_records.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

using TableRow = std::vector<std::string>;

/// Cells in columns, two blanks between.
std::string aligned(const std::vector<TableRow>& rows) {
  std::vector<std::size_t> widths;
  for (const TableRow& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string text;
  for (const TableRow& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += fmt::format("{:<{}}  ", row[k], widths[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string nm(const Json& statistics) {
  return fmt::format("{:.4g}", statistics_of_record(statistics).rms_about_zero());
}

std::string number(const Json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

/// "1.2 / 0.3 / 0.1": RMS in the bands of the surface, long waves first.
std::string bands_cell(const Json& surface) {
  std::string text;
  for (const Json& band : surface.at("after").at("bands"))
    text += (text.empty() ? "" : " / ") + number(band.at("rms_nm"), "{:.3g}");
  return text;
}

std::string estimate_cell(const Json& estimate, const char* format) { return number(estimate.at("value"), format); }

TableRow row_of(const RunStep& step, bool withdrawn) {
  const Json& c = step.content;
  const std::string name = fmt::format("{}", step.number), mark = withdrawn ? " (withdrawn)" : "";
  if (step.kind == step_kinds::kNew) return {name, "first map", nm(c.at("before"))};
  if (step.kind == step_kinds::kPlan) {
    return {name,
            fmt::format("plan {}", step.iteration),
            nm(c.at("before")),
            nm(c.at("predicted")),
            "",
            "",
            duration_text(c.at("run_s")),
            "",
            number(c.at("tool").at("rate"), "{:.4g}"),
            number(c.at("tool").at("width"), "{:.4g}")};
  }
  if (step.kind == step_kinds::kWithdrawn) return {name, fmt::format("withdrawal of {}", c.at("step").get<int>())};
  const Json& found = c.at("registration");
  return {name,
          fmt::format("measured {}{}", step.iteration, mark),
          nm(c.at("before")),
          nm(c.at("predicted")),
          nm(c.at("after")),
          number(c.at("convergence"), "{:.3g}"),
          duration_text(c.at("run_s")),
          bands_cell(c.at("surface")),
          estimate_cell(found.at("rate"), "x {:.4g}"),
          estimate_cell(found.at("width"), "x {:.4g}")};
}

/// What to do next, and what the last measurement advised.
std::string next_lines(const RunFolder& run, const FigureState& state) {
  const std::string name = run.folder().string();
  std::string text;
  const RunStep& map = run.step(state.map_step);
  if (map.kind == step_kinds::kMeasured)
    text += fmt::format("advice    {}\n", map.content.at("next_run").at("advice").get<std::string>());
  if (state.plan_step) {
    const RunStep& plan = run.step(*state.plan_step);
    text += fmt::format("next      run {}/{}/{}, then dwell figure measured {} MAP\n", name, plan.folder,
                        plan.content.at("program").at("file").get<std::string>(), name);
  } else {
    text += fmt::format("next      dwell figure plan {}\n", name);
  }
  return text;
}

}  // namespace

std::string status_text(const RunFolder& run) {
  const FigureState state = figure_state(run);
  std::vector<TableRow> rows{{"step", "what", "before [nm]", "predicted [nm]", "measured [nm]", "convergence",
                              "run time", "left by waves [nm]", "rate", "width"}};
  for (const RunStep& step : run.steps()) rows.push_back(row_of(step, state.withdrawn.contains(step.number)));
  std::string text = fmt::format("run       {}: {} measured, RMS of the surface, {} removed\n", run.folder().string(),
                                 counted(state.runs, "run"), run.step(1).content.at("removed").get<std::string>());
  if (!state.target.empty()) text += fmt::format("target    {}\n", surface_limits_text(state.limits));
  return text + aligned(rows) + next_lines(run, state);
}

Json status_json(const RunFolder& run) {
  const FigureState state = figure_state(run);
  Json json = json_of_command("figure status");
  json["run"] = run.folder().string();
  json["target"] = state.target;
  json["runs"] = state.runs;
  json["learnt"] = {{"tif_rate", state.options.tif_rate},
                    {"tif_width", state.options.tif_width},
                    {"zero_mm", {state.options.zero_mm.x, state.options.zero_mm.y}},
                    {"rotate_deg", state.options.rotate_deg}};
  json["map_step"] = state.map_step;
  json["plan_step"] = state.plan_step ? Json(*state.plan_step) : Json(nullptr);
  Json steps = Json::array();
  for (const RunStep& step : run.steps()) {
    const Json& c = step.content;
    const auto rms = [&c](const char* key) {
      return c.contains(key) ? Json(statistics_of_record(c.at(key)).rms_about_zero()) : Json(nullptr);
    };
    steps.push_back({{"step", step.number},
                     {"kind", step.kind},
                     {"iteration", step.iteration},
                     {"folder", step.folder},
                     {"withdrawn", state.withdrawn.contains(step.number)},
                     {"before_rms_nm", rms("before")},
                     {"predicted_rms_nm", rms("predicted")},
                     {"after_rms_nm", rms("after")},
                     {"convergence", c.value("convergence", Json(nullptr))},
                     {"run_s", c.value("run_s", Json(nullptr))}});
  }
  json["steps"] = std::move(steps);
  const RunStep& map = run.step(state.map_step);
  const bool measured = map.kind == step_kinds::kMeasured;
  json["advice"] = measured ? map.content.at("next_run").at("advice") : Json(nullptr);
  return json;
}

}  // namespace dwell
