#include "paths/feed/kinematic_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/errors.h"

namespace dwell {
namespace {

// Coordinates in files are rounded to 1e-6 mm, or to the resolution of the controller's places, which turns a straight
// line by no more than twice that over the length of a move, and no machine tells a tenth of a milliradian from
// straight on.
constexpr double kFilePlaces = 1e-6;  // [mm]
constexpr double kStraightOn = 1e-4;  // [rad]
// Moves that turn back so far meet at a stop, also where the machine blends.
constexpr double kTurnsBack = 178.0 / 180.0 * std::numbers::pi;  // [rad]
constexpr double kAnySpeed = std::numeric_limits<double>::infinity();

/// How much two moves turn [rad], counter-clockwise positive; 0 where rounding may be all of it.
double turn_between(const ProgramStep& before, const ProgramStep& after, const Machine& machine) {
  const Point a = before.finish - before.start, b = after.finish - after.start;
  const double rounding = 2.0 * std::max(kFilePlaces, machine.controller.position_resolution);
  const double turn = std::atan2(a.x * b.y - a.y * b.x, dot(a, b));
  return std::abs(turn) <= kStraightOn + rounding * (1.0 / length(a) + 1.0 / length(b)) ? 0.0 : turn;
}

/// What holds at the end of a step: a rule for corners, whether it holds straight on as well, and the tolerance of the
/// rule Blend.
struct EndRule {
  CornerRule corner;
  bool everywhere;
  double tolerance;
};

class PathMaker {
 public:
  /// `least`: the shortest time of a move at work [s].
  PathMaker(const std::vector<ProgramStep>& steps, const Machine& machine, double max_feed, double least)
      : steps_(steps), machine_(machine) {
    path_.moves.reserve(steps.size());
    for (const ProgramStep& step : steps) {
      const Point along = step.finish - step.start;
      path_.moves.push_back({length(along), std::min(speed_limit(machine, along), max_feed),
                             acceleration_limit(machine, along), jerk_limit(machine, along)});
      KinematicMove& move = path_.moves.back();
      if (least > 0.0 && step.removes && move.length > 0.0)
        move.max_speed = std::min(move.max_speed, move.length / least);
    }
    path_.corner.assign(steps.size() + 1, 0.0);
    path_.stops.assign(steps.size() + 1, 0);
  }

  template <class RuleAt>
  KinematicPath make(const RuleAt& rule_at) {
    for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
      const EndRule rule = rule_at(i);
      if (!(path_.moves[i].length > 0.0) || !(path_.moves[i + 1].length > 0.0) ||
          steps_[i].removes != steps_[i + 1].removes) {
        continue;
      }
      path_.corner[i + 1] = rule.everywhere ? 0.0 : corner_between(i, rule);
      path_.stops[i + 1] = static_cast<char>(path_.corner[i + 1] == 0.0);
    }
    return std::move(path_);
  }

 private:
  /// The highest squared speed between move i and the next; where it blends, the arc besides.
  double corner_between(std::size_t i, const EndRule& rule) {
    const double turn = turn_between(steps_[i], steps_[i + 1], machine_);
    if (turn == 0.0) return kAnySpeed;
    switch (rule.corner) {
      case CornerRule::ExactStop:
        return 0.0;
      case CornerRule::Free:
        return kAnySpeed;
      case CornerRule::Blend:
        return blend(i, turn, rule.tolerance);
      case CornerRule::JunctionDeviation:
        break;
    }
    const double acceleration = std::min(path_.moves[i].acceleration, path_.moves[i + 1].acceleration);
    const double s = std::cos(0.5 * std::abs(turn));  // the angle between the moves lacks the turn to a half circle
    return acceleration * machine_.junction_deviation * s / (1.0 - s);
  }

  double blend(std::size_t i, double turn, double tolerance) {
    if (std::abs(turn) > kTurnsBack) return 0.0;
    if (path_.arcs.empty()) path_.arcs.resize(steps_.size() + 1);
    path_.arc_jerk = jerk_everywhere(machine_);
    const BlendArc arc = blend_arc(blend_move(i), blend_move(i + 1), turn, tolerance, machine_);
    if (!(arc.radius > 0.0)) return kAnySpeed;  // the acceleration has no limit
    path_.arcs[i + 1] = arc;
    return arc.max_speed * arc.max_speed;
  }

  BlendMove blend_move(std::size_t i) const {
    const ProgramStep& step = steps_[i];
    const KinematicMove& move = path_.moves[i];
    const double feed = step.seconds > 0.0 ? std::min(move.max_speed, move.length / step.seconds) : move.max_speed;
    return {move.length, feed};
  }

  const std::vector<ProgramStep>& steps_;
  const Machine& machine_;
  KinematicPath path_;
};

/// The tolerance within which a machine blends after a change of the path mode [mm]. Throws where none is known.
double blend_tolerance(const Program& program, const PathModeChange& change, const Machine& machine) {
  if (change.mode.merging_mm.value_or(0.0) > 0.0) {
    throw InputError(fmt::format(
        "{}: from step {} on the controller may put one move in the place of several that lie within {:.6g} "
        "mm of it (G64 Q), which is not simulated; required Q0, or no Q",
        program.file, change.first_step + 1, *change.mode.merging_mm));
  }
  if (change.mode.tolerance_mm.value_or(0.0) > 0.0) return *change.mode.tolerance_mm;
  if (machine.corner == CornerRule::Blend) return machine.blend_tolerance;
  throw InputError(
      fmt::format("{}: from step {} on the controller rounds corners as far as it likes (G64 without P), and where the "
                  "tool then goes is not in the program; required G64 with P, or a machine with the corner rule blend "
                  "and its tolerance",
                  program.file, change.first_step + 1));
}

EndRule rule_of(const Program& program, const PathModeChange& change, const Machine& machine) {
  switch (change.mode.kind) {
    case PathMode::Kind::ExactPath:
      return {CornerRule::ExactStop, false, 0.0};
    case PathMode::Kind::ExactStop:
      return {CornerRule::ExactStop, true, 0.0};
    case PathMode::Kind::Blended:
      break;
  }
  return {CornerRule::Blend, false, blend_tolerance(program, change, machine)};
}

/// The highest squared speed that is reached over a way.
double reached_squared(const SpeedChange& change, double u, double length) {
  if (!change.limits_jerk()) return u + 2.0 * change.acceleration * length;
  const double v = change.reached(std::sqrt(u), length);
  return v * v;
}

/// One part of a move while it is put together.
struct StretchLimits {
  double length = 0.0, most = kAnySpeed;
  SpeedChange change{0.0};

  /// The highest squared speed at one end for one at the other.
  double reached(double u) const { return length > 0.0 ? reached_squared(change, u, length) : u; }
};

using Parts = std::array<StretchLimits, 3>;

Parts parts_of(const KinematicPath& path, std::size_t i, double feed) {
  const KinematicMove& move = path.moves[i];
  Parts parts;
  double straight = move.length;
  for (const std::size_t end : {0U, 1U}) {
    const BlendArc& arc = path.arcs[i + end];
    if (!(arc.radius > 0.0)) continue;
    parts[2 * end] = {
        arc.half_length(), std::min({arc.max_speed, move.max_speed, feed}), {arc.acceleration, path.arc_jerk}};
    straight -= arc.cut;
  }
  parts[1] = {std::max(0.0, straight), std::min(move.max_speed, feed), move.change()};
  return parts;
}

double square_of(double v) { return v * v; }

/// Between two parts, the squared speed that both allow.
double between(const StretchLimits& a, const StretchLimits& b) { return square_of(std::min(a.most, b.most)); }

}  // namespace

KinematicPath kinematic_path(const std::vector<ProgramStep>& steps, const Machine& machine, double max_feed) {
  return PathMaker(steps, machine, max_feed, least_block_seconds(machine)).make([&machine](std::size_t) {
    return EndRule{machine.corner, false, machine.blend_tolerance};
  });
}

KinematicPath kinematic_path(const Program& program, const Machine& machine_of_part) {
  const Machine machine = machine_on(machine_of_part, program);
  std::vector<EndRule> rules;
  for (const PathModeChange& change : program.path_modes) rules.push_back(rule_of(program, change, machine));
  std::size_t next = 0;
  EndRule rule{machine.corner, false, machine.blend_tolerance};
  return PathMaker(program.steps, machine, kAnySpeed, 0.0).make([&](std::size_t step) {
    for (; next < rules.size() && program.path_modes[next].first_step <= step; ++next) rule = rules[next];
    return rule;
  });
}

MoveParts move_parts(const KinematicPath& path, std::size_t i, double feed, double u_in, double u_out) {
  const KinematicMove& move = path.moves[i];
  MoveParts made{};
  if (path.arcs.empty()) {
    made.part[1] = {move.length, move.acceleration, std::sqrt(u_in), std::sqrt(u_out), kAnySpeed, move.jerk};
    return made;
  }
  const Parts parts = parts_of(path, i, feed);
  const double first = std::min(between(parts[0], parts[1]), parts[0].reached(u_in));
  double second = std::min(between(parts[1], parts[2]), parts[1].reached(first));
  second = std::min(second, parts[2].reached(u_out));
  const std::array<double, 4> v{std::sqrt(u_in), std::sqrt(std::min(first, parts[1].reached(second))),
                                std::sqrt(second), std::sqrt(u_out)};
  for (std::size_t k = 0; k < parts.size(); ++k)
    made.part[k] = {parts[k].length,
                    parts[k].change.acceleration,
                    v[k],
                    v[k + 1],
                    k == 1 ? move.max_speed : path.arcs[i + k / 2].max_speed,
                    parts[k].change.jerk};
  return made;
}

double MoveParts::seconds(double feed) const {
  double sum = 0.0;
  for_each([&](const Trapezoid& trapezoid, std::size_t) { sum += time_at_feed(trapezoid, feed); });
  return sum;
}

double reached_forward(const KinematicPath& path, std::size_t i, double feed, double u) {
  if (path.arcs.empty()) return reached_squared(path.moves[i].change(), u, path.moves[i].length);
  const Parts parts = parts_of(path, i, feed);
  const double first = std::min(between(parts[0], parts[1]), parts[0].reached(u));
  return parts[2].reached(std::min(between(parts[1], parts[2]), parts[1].reached(first)));
}

double reached_back(const KinematicPath& path, std::size_t i, double feed, double u) {
  if (path.arcs.empty()) return reached_squared(path.moves[i].change(), u, path.moves[i].length);
  const Parts parts = parts_of(path, i, feed);
  const double second = std::min(between(parts[1], parts[2]), parts[2].reached(u));
  return parts[0].reached(std::min(between(parts[0], parts[1]), parts[1].reached(second)));
}

std::vector<double> node_speeds_squared(const KinematicPath& path, const std::vector<double>& feed) {
  const std::size_t n = path.size();
  std::vector<double> u = path.corner;
  for (std::size_t i = 0; i < n; ++i) {
    const double highest = square_of(std::min(feed[i], path.moves[i].max_speed));
    u[i] = std::min(u[i], highest);
    u[i + 1] = std::min(u[i + 1], highest);
  }
  for (std::size_t i = 0; i < n; ++i) u[i + 1] = std::min(u[i + 1], reached_forward(path, i, feed[i], u[i]));
  for (std::size_t i = n; i-- > 0;) u[i] = std::min(u[i], reached_back(path, i, feed[i], u[i + 1]));
  return u;
}

}  // namespace dwell
