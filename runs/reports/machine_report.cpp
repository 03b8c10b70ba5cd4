#include "runs/reports/machine_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "paths/feed/speed_change.h"
#include "runs/base/inputs_json.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

std::string limit_words(double value, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.6g} {}", value, unit) : fmt::format("any {}", unit);
}

/// " and 3000 mm/s^3"; empty without a limit.
std::string jerk_words(double jerk) { return std::isfinite(jerk) ? fmt::format(" and {:.6g} mm/s^3", jerk) : ""; }

std::string axis_words(char name, const MachineAxis& axis) {
  const bool travels = std::isfinite(axis.lowest) || std::isfinite(axis.highest);
  const std::string travel =
      travels ? fmt::format("from {:.6g} to {:.6g} mm", axis.lowest, axis.highest) : std::string("of any travel");
  return fmt::format("{} {}, at most {} and {}{}", name, travel, limit_words(axis.max_speed, "mm/s"),
                     limit_words(axis.max_acceleration, "mm/s^2"), jerk_words(axis.max_jerk));
}

char lower(char letter) { return static_cast<char>(letter - 'A' + 'a'); }

/// What its controller takes; empty if that is anything.
std::string controller_line(const ControllerLimits& c) {
  std::string words;
  const auto add = [&words](const std::string& what) { words += (words.empty() ? "" : ", ") + what; };
  if (std::isfinite(c.max_blocks_per_s)) add(fmt::format("{:.6g} blocks/s", c.max_blocks_per_s));
  if (c.time_resolution > 0.0) add(fmt::format("times to {:.6g} s", c.time_resolution));
  if (c.position_resolution > 0.0) add(fmt::format("places to {:.6g} mm", c.position_resolution));
  return words.empty() ? "" : fmt::format("control   {}\n", words);
}

std::string corner_words(const Machine& m) {
  switch (m.corner) {
    case CornerRule::ExactStop:
      return fmt::format("exact-stop: rests at every corner, {:.6g} s at each", m.corner_delay);
    case CornerRule::JunctionDeviation:
      return fmt::format("junction-deviation: at the speed of an arc {:.6g} mm beside the corner",
                         m.junction_deviation);
    case CornerRule::Free:
      return "free: at full speed";
    case CornerRule::Blend:
      return fmt::format(
          "blend: on arcs within {:.6g} mm of the corner, {}; of the acceleration {:.6g} across the path and {:.6g} "
          "along it",
          m.blend_tolerance,
          m.blend_size == BlendSize::Largest ? "as large as that allows" : "no larger than the feeds need",
          m.across_share, m.along_share);
  }
  return "";
}

/// The rests at lifts; empty without any.
std::string lift_line(const LiftTimes& lift) {
  if (lift == LiftTimes{}) return "";
  return fmt::format("lifts     rest {:.6g} s up, {:.6g} s before coming down, {:.6g} s down, which removes\n",
                     lift.lift, lift.plunge, lift.settle);
}

/// What it costs to come to rest from a feed and to start again.
std::string stop_words(const Machine& m, double feed) {
  const double seconds = SpeedChange{acceleration_everywhere(m), jerk_everywhere(m)}.seconds(feed);
  return fmt::format("{:.6g} mm/min {:.3g} ms over {:.3g} mm", units::mm_per_min(feed), 1e3 * seconds, feed * seconds);
}

std::string stop_line(const Machine& m) {
  const double feed = speed_everywhere(m);
  if (!std::isfinite(feed) || !std::isfinite(acceleration_everywhere(m))) return "";
  return fmt::format("a stop    down to rest and up again costs, from {}; from {}\n", stop_words(m, 0.1 * feed),
                     stop_words(m, feed));
}

}  // namespace

std::string machine_lines(const NamedMachine& machine) {
  const Machine& m = machine.machine;
  const std::string feed =
      std::isfinite(m.max_feed)
          ? fmt::format("{:.6g} to {:.6g} mm/min", units::mm_per_min(m.min_feed), units::mm_per_min(m.max_feed))
          : fmt::format("from {:.6g} mm/min on", units::mm_per_min(m.min_feed));
  return fmt::format("machine   {}\naxes      {}\n          {}\npath      {}, {}{}\ncorners   {}\n",
                     machine.name.empty() ? "without a name" : machine.name, axis_words(lower(m.letters.x), m.x),
                     axis_words(lower(m.letters.y), m.y), feed, limit_words(m.path_acceleration, "mm/s^2"),
                     jerk_words(m.path_jerk), corner_words(m)) +
         lift_line(m.lift) + controller_line(m.controller) + stop_line(m);
}

std::string lift_words(const LiftTotals& totals) {
  if (!totals.any()) return "";
  return fmt::format("rests {:.2f} s at {} and {:.2f} s before coming down {}; settling {:.2f} s, which removes",
                     totals.lift, counted(totals.lifts, "lift"), totals.plunge, counted(totals.plunges, "time"),
                     totals.settle);
}

nlohmann::ordered_json lift_block(const LiftTotals& totals) {
  return {{"lifts", totals.lifts},
          {"plunges", totals.plunges},
          {"up_s", totals.lift},
          {"down_s", totals.plunge},
          {"settle_s", totals.settle}};
}

nlohmann::ordered_json machine_block(const NamedMachine& machine) {
  nlohmann::ordered_json json;
  json["name"] = machine.name;
  Machine copy = machine.machine;
  for (const MachineField& field : machine_fields()) {
    const std::string prefix = field.section.empty() ? "" : field.section + "_";
    json[prefix + field.key] = finite_or_null(field.value(copy) / field.scale);
  }
  json["x_letter"] = std::string(1, machine.machine.letters.x);
  json["y_letter"] = std::string(1, machine.machine.letters.y);
  json["corner_rule"] = to_string(machine.machine.corner);
  json["corner_arcs"] = to_string(machine.machine.blend_size);
  return json;
}

std::string machine_json(const NamedMachine& machine, const std::string& file) {
  nlohmann::ordered_json json = json_of_command("machine");
  json["machine"] = machine_block(machine);
  json["inputs"] = inputs_json({{"machine", file, sha256_of_file(file)}});
  return json_text(std::move(json));
}

}  // namespace dwell
