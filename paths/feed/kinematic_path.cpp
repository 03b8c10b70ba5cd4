#include "paths/feed/kinematic_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"

namespace dwell {
namespace {

// Coordinates in files are rounded to 1e-6 mm, or to the resolution of the controller's places, which turns a straight
// line by no more than twice that over the length of a move, and no machine tells a tenth of a milliradian from
// straight on.
constexpr double kFilePlaces = 1e-6;  // [mm]
constexpr double kStraightOn = 1e-4;  // [rad]

/// The highest squared speed between two moves.
double corner_speed_squared(const ProgramStep& before, const ProgramStep& after, double acceleration, CornerRule rule,
                            const Machine& machine) {
  const Point a = before.finish - before.start, b = after.finish - after.start;
  const double la = length(a), lb = length(b);
  const double turn = std::atan2(std::abs(a.x * b.y - a.y * b.x), dot(a, b));
  const double rounding = 2.0 * std::max(kFilePlaces, machine.controller.position_resolution);
  if (turn <= kStraightOn + rounding * (1.0 / la + 1.0 / lb)) return std::numeric_limits<double>::infinity();
  switch (rule) {
    case CornerRule::ExactStop:
      return 0.0;
    case CornerRule::Free:
      return std::numeric_limits<double>::infinity();
    case CornerRule::JunctionDeviation:
      break;
  }
  const double s = std::cos(0.5 * turn);  // the angle between the moves is what the turn lacks to a half circle
  return acceleration * machine.junction_deviation * s / (1.0 - s);
}

/// What holds at the end of a step: a rule for corners, and whether it holds straight on as well.
struct EndRule {
  CornerRule corner;
  bool everywhere;
};

template <class RuleAt>
KinematicPath make_path(const std::vector<ProgramStep>& steps, const Machine& machine, const RuleAt& rule_at) {
  KinematicPath path;
  path.moves.reserve(steps.size());
  for (const ProgramStep& step : steps) {
    const Point along = step.finish - step.start;
    path.moves.push_back({length(along), speed_limit(machine, along), acceleration_limit(machine, along)});
  }
  path.corner.assign(steps.size() + 1, 0.0);
  path.stops.assign(steps.size() + 1, 0);
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const KinematicMove &before = path.moves[i], &after = path.moves[i + 1];
    if (!(before.length > 0.0) || !(after.length > 0.0) || steps[i].removes != steps[i + 1].removes) continue;
    const EndRule rule = rule_at(i);
    const double acceleration = std::min(before.acceleration, after.acceleration);
    path.corner[i + 1] =
        rule.everywhere ? 0.0 : corner_speed_squared(steps[i], steps[i + 1], acceleration, rule.corner, machine);
    path.stops[i + 1] = static_cast<char>(path.corner[i + 1] == 0.0);
  }
  return path;
}

void refuse_blending(const Program& program) {
  for (const PathModeChange& change : program.path_modes) {
    if (change.mode.kind != PathMode::Kind::Blended) continue;
    throw InputError(fmt::format(
        "{}: from step {} on the controller may round corners (G64), and where the tool then goes is not in the "
        "program; its motion on a machine can be told for G61 and G61.1, or without a path mode",
        program.file, change.first_step + 1));
  }
}

}  // namespace

KinematicPath kinematic_path(const std::vector<ProgramStep>& steps, const Machine& machine, double max_feed) {
  KinematicPath path = make_path(steps, machine, [&machine](std::size_t) { return EndRule{machine.corner, false}; });
  const double least = least_block_seconds(machine);
  for (std::size_t i = 0; i < path.size(); ++i) {
    KinematicMove& move = path.moves[i];
    move.max_speed = std::min(move.max_speed, max_feed);
    if (least > 0.0 && steps[i].removes && move.length > 0.0)
      move.max_speed = std::min(move.max_speed, move.length / least);
  }
  return path;
}

KinematicPath kinematic_path(const Program& program, const Machine& machine) {
  refuse_blending(program);
  std::size_t next = 0;
  EndRule rule{machine.corner, false};
  return make_path(program.steps, machine_on(machine, program), [&](std::size_t step) {
    for (; next < program.path_modes.size() && program.path_modes[next].first_step <= step; ++next)
      rule = {CornerRule::ExactStop, program.path_modes[next].mode.kind == PathMode::Kind::ExactStop};
    return rule;
  });
}

std::vector<double> node_speeds_squared(const KinematicPath& path, const std::vector<double>& feed) {
  const std::size_t n = path.size();
  std::vector<double> u = path.corner;
  const auto highest = [&](std::size_t i) {
    const double v = std::min(feed[i], path.moves[i].max_speed);
    return v * v;
  };
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = std::min(u[i], highest(i));
    u[i + 1] = std::min(u[i + 1], highest(i));
  }
  const auto gain = [&](std::size_t i) { return 2.0 * path.moves[i].acceleration * path.moves[i].length; };
  for (std::size_t i = 0; i < n; ++i) u[i + 1] = std::min(u[i + 1], u[i] + gain(i));
  for (std::size_t i = n; i-- > 0;) u[i] = std::min(u[i], u[i + 1] + gain(i));
  return u;
}

}  // namespace dwell
