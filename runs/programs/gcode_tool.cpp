#include "runs/programs/gcode_tool.h"

#include <fmt/format.h>

namespace dwell {
namespace {

std::string shown(char letter, std::optional<double> value) {
  return value ? fmt::format("{}{}", letter, *value) : "none";
}

std::string shown_spindle(std::optional<int> spindle) { return spindle ? fmt::format("M{}", *spindle) : "none"; }

std::string shown_coolants(const GcodeTool& tool) {
  if (!tool.mist && !tool.flood) return "off";
  return tool.mist && tool.flood ? "M7 and M8" : tool.mist ? "M7" : "M8";
}

}  // namespace

void GcodeTool::take(const GcodeBlock& block) {
  if (block.tool) number = block.tool;
  if (block.change_tool) ++changes;
  if (block.s) speed = block.s;
  if (block.spindle) spindle = block.spindle;
  if (block.coolants_off) mist = flood = false;
  mist = mist || block.mist;
  flood = flood || block.flood;
}

std::string tool_difference(const GcodeTool& before, const GcodeTool& now) {
  if (now.number != before.number) {
    return fmt::format("the tool is {}, before {}", shown('T', now.number), shown('T', before.number));
  }
  if (now.changes != before.changes) return "the tool was changed (M6)";
  if (now.speed != before.speed) {
    return fmt::format("the spindle's speed is {}, before {}", shown('S', now.speed), shown('S', before.speed));
  }
  if (now.spindle != before.spindle) {
    return fmt::format("the spindle is {}, before {}", shown_spindle(now.spindle), shown_spindle(before.spindle));
  }
  if (now.mist != before.mist || now.flood != before.flood) {
    return fmt::format("the coolant is {}, before {}", shown_coolants(now), shown_coolants(before));
  }
  return "";
}

}  // namespace dwell
