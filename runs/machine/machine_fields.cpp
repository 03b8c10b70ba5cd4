#include "runs/machine/machine_fields.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace dwell {
namespace {

constexpr double kPerMinute = units::mm_per_s(1.0);
constexpr double kAny = -std::numeric_limits<double>::infinity();

using Access = double& (*)(Machine&);

void add_axis(std::vector<MachineField>& fields, const char* section, const char* words, std::array<Access, 5> access) {
  fields.push_back({section, "lowest_mm", fmt::format("end of the travel {}", words), kAny, false, access[0], 1.0});
  fields.push_back({section, "highest_mm", "the other end", kAny, false, access[1], 1.0});
  fields.push_back({section, "max_speed_mm_per_s", "of this axis alone", 0.0, true, access[2], 1.0});
  fields.push_back({section, "max_acceleration_mm_per_s2", "of this axis alone", 0.0, true, access[3], 1.0});
  fields.push_back({section, "max_jerk_mm_per_s3", "of this axis alone", 0.0, true, access[4], 1.0});
}

std::vector<MachineField> make_fields() {
  std::vector<MachineField> fields{
      {"", "max_feed_mm_per_min", "along the path, for feed moves and rapids", 0.0, true,
       [](Machine& m) -> double& { return m.max_feed; }, kPerMinute},
      {"", "min_feed_mm_per_min", "along the path", 0.0, false, [](Machine& m) -> double& { return m.min_feed; },
       kPerMinute},
      {"", "path_acceleration_mm_per_s2", "along the path", 0.0, true,
       [](Machine& m) -> double& { return m.path_acceleration; }, 1.0},
      {"", "path_jerk_mm_per_s3", "along the path, of changes of speed", 0.0, true,
       [](Machine& m) -> double& { return m.path_jerk; }, 1.0},
      {"corner", "junction_deviation_mm", "for the rule junction-deviation", 0.0, true,
       [](Machine& m) -> double& { return m.junction_deviation; }, 1.0},
      {"corner", "tolerance_mm", "for the rule blend; G64 P of a program comes before it", 0.0, true,
       [](Machine& m) -> double& { return m.blend_tolerance; }, 1.0},
      {"corner", "across_share", "of the acceleration, on arcs of the rule blend, across the path; LinuxCNC 0.866", 0.0,
       true, [](Machine& m) -> double& { return m.across_share; }, 1.0},
      {"corner", "along_share", "along the path; LinuxCNC 0.5", 0.0, true,
       [](Machine& m) -> double& { return m.along_share; }, 1.0},
      {"corner", "delay_s", "at rest at each exact stop", 0.0, false,
       [](Machine& m) -> double& { return m.corner_delay; }, 1.0},
      {"lift", "up_s", "rest with the tool up when it is lifted, beside its way up", 0.0, false,
       [](Machine& m) -> double& { return m.lift.lift; }, 1.0},
      {"lift", "down_s", "rest with the tool up when it is lowered, beside its way down", 0.0, false,
       [](Machine& m) -> double& { return m.lift.plunge; }, 1.0},
      {"lift", "settle_s", "rest with the tool down before it moves: that removes", 0.0, false,
       [](Machine& m) -> double& { return m.lift.settle; }, 1.0},
      {"controller", "max_blocks_per_s", "lines of a program that it takes in a second", 0.0, true,
       [](Machine& m) -> double& { return m.controller.max_blocks_per_s; }, 1.0},
      {"controller", "time_resolution_s", "step of its clock; 0: as files have it", 0.0, false,
       [](Machine& m) -> double& { return m.controller.time_resolution; }, 1.0},
      {"controller", "position_resolution_mm", "step of its places; 0: as files have it", 0.0, false,
       [](Machine& m) -> double& { return m.controller.position_resolution; }, 1.0}};
  add_axis(
      fields, "x", "[mm in the program's coordinates]",
      {[](Machine& m) -> double& { return m.x.lowest; }, [](Machine& m) -> double& { return m.x.highest; },
       [](Machine& m) -> double& { return m.x.max_speed; }, [](Machine& m) -> double& { return m.x.max_acceleration; },
       [](Machine& m) -> double& { return m.x.max_jerk; }});
  add_axis(
      fields, "y", "[mm in the program's coordinates]",
      {[](Machine& m) -> double& { return m.y.lowest; }, [](Machine& m) -> double& { return m.y.highest; },
       [](Machine& m) -> double& { return m.y.max_speed; }, [](Machine& m) -> double& { return m.y.max_acceleration; },
       [](Machine& m) -> double& { return m.y.max_jerk; }});
  return fields;
}

}  // namespace

const std::vector<MachineField>& machine_fields() {
  static const std::vector<MachineField> kFields = make_fields();
  return kFields;
}

std::string field_text(const MachineField& field, const Machine& machine) {
  Machine copy = machine;
  const double value = field.value(copy) / field.scale;
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

}  // namespace dwell
