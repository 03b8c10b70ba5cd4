#include "paths/feed/trapezoid_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/lasting_pieces.h"
#include "paths/feed/step_times.h"
#include "paths/feed/trapezoid.h"

namespace dwell {
namespace {

constexpr double kAnyTime = 1e-9;  // [s] below that, the ends of a piece are rounding

class Pieces {
 public:
  Pieces(const Program& program, const Machine& machine, double least_seconds)
      : program_(program),
        machine_(machine),
        least_(std::max(least_seconds, kAnyTime)),
        path_(kinematic_path(program, machine)) {
    if (!path_.arcs.empty()) {
      throw InputError(
          "the machine blends corners, on arcs which are no pieces of constant acceleration; required another rule for "
          "corners");
    }
    feed_ = commanded_feeds(program, path_);
    u_ = node_speeds_squared(path_, feed_);
    result_.motion.file = program.file;
    result_.motion.fastest_feed = std::isfinite(machine.max_feed) ? machine.max_feed : program.fastest_feed;
  }

  TrapezoidProgram run() {
    for (std::size_t i = 0; i < program_.steps.size(); ++i) {
      result_.seconds.push_back(run_step(i) + half_rest(i) + half_rest(i + 1));
      const Point end = program_.steps[i].finish;
      if (path_.stops[i + 1] != 0 && machine_.corner_delay > 0.0)
        result_.motion.steps.push_back({end, end, machine_.corner_delay, true});
    }
    return std::move(result_);
  }

 private:
  double half_rest(std::size_t node) const { return path_.stops[node] != 0 ? 0.5 * machine_.corner_delay : 0.0; }

  double run_step(std::size_t i) {
    const ProgramStep& step = program_.steps[i];
    const KinematicMove& move = path_.moves[i];
    if (!(move.length > 0.0)) {
      result_.motion.steps.push_back(step);
      return step.seconds;
    }
    if (!std::isfinite(move.acceleration)) {
      throw InputError(fmt::format(
          "machine: no acceleration is limited along step {}, where the speed then jumps; required max_acceleration of "
          "both axes, or path_acceleration, for a program of positions, velocities and times",
          i + 1));
    }
    const Point along = (1.0 / move.length) * (step.finish - step.start);
    Point from = step.start;
    double travelled = 0.0, seconds = 0.0;
    for (const MotionPiece& piece :
         lasting_pieces({move.length, move.acceleration, std::sqrt(u_[i]), std::sqrt(u_[i + 1])}, feed_[i], least_)) {
      travelled += piece.length;
      const Point to = step.start + std::min(move.length, travelled) * along;
      result_.motion.steps.push_back(
          {from, to, piece.seconds(), step.removes, EndSpeeds{piece.speed_in * along, piece.speed_out * along}});
      seconds += piece.seconds();
      from = to;
    }
    result_.motion.steps.back().finish = step.finish;  // chained exactly
    return seconds;
  }

  const Program& program_;
  const Machine& machine_;
  double least_;
  KinematicPath path_;
  std::vector<double> feed_, u_;
  TrapezoidProgram result_;
};

}  // namespace

TrapezoidProgram trapezoid_program(const Program& program, const Machine& machine, double least_seconds) {
  return Pieces(program, machine, least_seconds).run();
}

}  // namespace dwell
