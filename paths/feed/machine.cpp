#include "paths/feed/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  if (axis.lowest < axis.highest) return;
  throw InputError(fmt::format("machine: {0}.travel: lowest {1} mm and highest {2} mm; required lowest < highest", name,
                               axis.lowest, axis.highest));
}

void check_min_feed(double min_feed, const char* field, double limit) {
  if (min_feed <= limit) return;
  throw InputError(fmt::format("machine: min_feed = {} mm/s and {} = {} mm/s; required min_feed <= {}", min_feed, field,
                               limit, field));
}

}  // namespace

std::string_view to_string(CornerRule rule) {
  switch (rule) {
    case CornerRule::ExactStop:
      return "exact-stop";
    case CornerRule::JunctionDeviation:
      return "junction-deviation";
    case CornerRule::Free:
      return "free";
  }
  return "";
}

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

void validate(const Machine& machine) {
  check_axis("x", machine.x);
  check_axis("y", machine.y);
  check_positive("max_feed", machine.max_feed, "mm/s");
  check_positive("path_acceleration", machine.path_acceleration, "mm/s^2");
  check_positive("junction_deviation", machine.junction_deviation, "mm");
  check_not_negative("corner_delay", machine.corner_delay, "s");
  check_not_negative("min_feed", machine.min_feed, "mm/s");
  check_not_negative("lift.up", machine.lift.lift, "s");
  check_not_negative("lift.down", machine.lift.plunge, "s");
  check_not_negative("lift.settle", machine.lift.settle, "s");
  check_min_feed(machine.min_feed, "max_feed", machine.max_feed);
  check_min_feed(machine.min_feed, "x.max_speed", machine.x.max_speed);
  check_min_feed(machine.min_feed, "y.max_speed", machine.y.max_speed);
}

}  // namespace dwell
