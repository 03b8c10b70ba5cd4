#include "runs/campaigns/sweep_sheet.h"

#include "runs/base/inputs_json.h"
#include "runs/reports/aim.h"
#include "runs/reports/map_line.h"
#include "runs/reports/options_json.h"
#include "runs/reports/plan_blocks.h"
#include "runs/reports/tool_sheet.h"

namespace dwell {

SweepSheet sweep_sheet(const Job& job, const std::vector<std::string>& unused) {
  const Part& part = *job.part;
  const CorrectionAim aim = correction_aim(job);
  const ToolSheet tool = tool_sheet(part.tif);
  SweepSheet sheet{plan_map_block(job),   aim_block(aim),
                   plan_tif_block(job),   tool_block(tool),
                   options_json(job),     inputs_json(job.inputs),
                   tool_lines(tool),      map_line(part.map.grid, part.before.valid_pixels) + aim_line(aim),
                   in_words(part.before), *about_zero_in_words(part.before) != '\0',
                   job.options.figures};
  for (const std::string& key : unused) sheet.options.erase(key);
  return sheet;
}

nlohmann::ordered_json sheet_json(const SweepSheet& sheet) {
  return {{"map", sheet.map},
          {"aim", sheet.aim},
          {"tif", sheet.tif},
          {"tool", sheet.tool},
          {"options", sheet.options},
          {"inputs", sheet.inputs},
          {"tool_lines", sheet.tool_lines},
          {"map_lines", sheet.map_lines},
          {"before", sheet.before},
          {"has_mean", sheet.has_mean},
          {"figures", to_string(sheet.figures)}};
}

SweepSheet sheet_of_json(const nlohmann::ordered_json& json) {
  return {json.at("map"),
          json.at("aim"),
          json.at("tif"),
          json.at("tool"),
          json.at("options"),
          json.at("inputs"),
          json.at("tool_lines"),
          json.at("map_lines"),
          json.at("before"),
          json.at("has_mean"),
          parse_figure_formats(json.at("figures").get<std::string>())};
}

}  // namespace dwell
