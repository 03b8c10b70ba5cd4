#include "paths/feed/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The largest length along a direction of which no component exceeds its axis's limit.
double limit_along(double of_x, double of_y, double of_path, Point along) {
  const double length = std::hypot(along.x, along.y);
  const auto of_axis = [length](double limit, double component) {
    return component == 0.0 ? kInfinity : limit * length / std::abs(component);
  };
  return std::min({of_path, of_axis(of_x, along.x), of_axis(of_y, along.y)});
}

void check_positive(const char* field, double value, const char* unit) {
  if (value > 0.0) return;
  throw InputError(fmt::format("machine: {} = {} {}; required > 0", field, value, unit));
}

void check_not_negative(const char* field, double value, const char* unit) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw InputError(fmt::format("machine: {} = {} {}; required finite and >= 0", field, value, unit));
}

void check_axis(const char* name, const MachineAxis& axis) {
  check_positive(fmt::format("{}.max_speed", name).c_str(), axis.max_speed, "mm/s");
  check_positive(fmt::format("{}.max_acceleration", name).c_str(), axis.max_acceleration, "mm/s^2");
  check_positive(fmt::format("{}.max_jerk", name).c_str(), axis.max_jerk, "mm/s^3");
  if (axis.lowest < axis.highest) return;
  throw InputError(fmt::format("machine: {0}.travel: lowest {1} mm and highest {2} mm; required lowest < highest", name,
                               axis.lowest, axis.highest));
}

void check_min_feed(double min_feed, const char* field, double limit) {
  if (min_feed <= limit) return;
  throw InputError(fmt::format("machine: min_feed = {} mm/s and {} = {} mm/s; required min_feed <= {}", min_feed, field,
                               limit, field));
}

void check_controller(const Machine& machine) {
  const ControllerLimits& c = machine.controller;
  check_positive("controller.max_blocks_per_s", c.max_blocks_per_s, "1/s");
  check_not_negative("controller.time_resolution", c.time_resolution, "s");
  check_not_negative("controller.position_resolution", c.position_resolution, "mm");
  if (!(c.time_resolution * c.max_blocks_per_s <= 1.0) && c.time_resolution > 0.0 &&
      std::isfinite(c.max_blocks_per_s)) {
    throw InputError(
        fmt::format("machine: controller.time_resolution = {} s and controller.max_blocks_per_s = {} 1/s; required at "
                    "least one step "
                    "of its clock a block, time_resolution <= {} s",
                    c.time_resolution, c.max_blocks_per_s, 1.0 / c.max_blocks_per_s));
  }
  for (const auto& [name, axis] : {std::pair{"x", machine.x}, std::pair{"y", machine.y}}) {
    if (c.position_resolution < axis.highest - axis.lowest) continue;
    throw InputError(fmt::format(
        "machine: controller.position_resolution = {} mm and {}.travel from {} to {} mm; required less than "
        "the travel",
        c.position_resolution, name, axis.lowest, axis.highest));
  }
}

void check_letters(const AxisLetters& letters) {
  for (const auto& [name, letter] : {std::pair{"x", letters.x}, std::pair{"y", letters.y}}) {
    if (kAxisLetters.find(letter) != std::string_view::npos) continue;
    throw InputError(fmt::format("machine: {}.letter = {}; accepted: one of {}", name, letter, kAxisLetters));
  }
  if (letters.x == letters.y) {
    throw InputError(
        fmt::format("machine: x.letter = {} and y.letter = {}; required two letters", letters.x, letters.y));
  }
}

}  // namespace

double least_block_seconds(const Machine& machine) {
  const ControllerLimits& controller = machine.controller;
  if (!std::isfinite(controller.max_blocks_per_s)) return 0.0;
  return 1.0 / controller.max_blocks_per_s + controller.time_resolution;
}

std::string_view to_string(CornerRule rule) {
  switch (rule) {
    case CornerRule::ExactStop:
      return "exact-stop";
    case CornerRule::JunctionDeviation:
      return "junction-deviation";
    case CornerRule::Free:
      return "free";
    case CornerRule::Blend:
      return "blend";
  }
  return "";
}

std::string_view to_string(BlendSize size) { return size == BlendSize::Largest ? "largest" : "as-needed"; }

Machine machine_on(Machine machine, const Program& program) {
  if (!program.frame.is_of_part()) machine.frame = program.frame;
  return machine;
}

double speed_limit(const Machine& machine, Point along) {
  return limit_along(machine.x.max_speed, machine.y.max_speed, machine.max_feed,
                     machine.frame.direction_to_program(along));
}

double acceleration_limit(const Machine& machine, Point along) {
  return limit_along(machine.x.max_acceleration, machine.y.max_acceleration, machine.path_acceleration,
                     machine.frame.direction_to_program(along));
}

double jerk_limit(const Machine& machine, Point along) {
  return limit_along(machine.x.max_jerk, machine.y.max_jerk, machine.path_jerk,
                     machine.frame.direction_to_program(along));
}

double jerk_everywhere(const Machine& machine) {
  return std::min({machine.path_jerk, machine.x.max_jerk, machine.y.max_jerk});
}

bool limits_jerk(const Machine& machine) { return std::isfinite(jerk_everywhere(machine)); }

double acceleration_everywhere(const Machine& machine) {
  return std::min({machine.path_acceleration, machine.x.max_acceleration, machine.y.max_acceleration});
}

double speed_everywhere(const Machine& machine) {
  return std::min({machine.max_feed, machine.x.max_speed, machine.y.max_speed});
}

void validate(const Machine& machine) {
  check_axis("x", machine.x);
  check_axis("y", machine.y);
  check_positive("max_feed", machine.max_feed, "mm/s");
  check_positive("path_acceleration", machine.path_acceleration, "mm/s^2");
  check_positive("path_jerk", machine.path_jerk, "mm/s^3");
  check_positive("junction_deviation", machine.junction_deviation, "mm");
  check_positive("blend_tolerance", machine.blend_tolerance, "mm");
  check_positive("across_share", machine.across_share, "of the acceleration");
  check_positive("along_share", machine.along_share, "of the acceleration");
  check_not_negative("corner_delay", machine.corner_delay, "s");
  check_not_negative("min_feed", machine.min_feed, "mm/s");
  check_not_negative("lift.up", machine.lift.lift, "s");
  check_not_negative("lift.down", machine.lift.plunge, "s");
  check_not_negative("lift.settle", machine.lift.settle, "s");
  check_controller(machine);
  check_letters(machine.letters);
  check_min_feed(machine.min_feed, "max_feed", machine.max_feed);
  check_min_feed(machine.min_feed, "x.max_speed", machine.x.max_speed);
  check_min_feed(machine.min_feed, "y.max_speed", machine.y.max_speed);
}

}  // namespace dwell
