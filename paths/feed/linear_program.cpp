#include "paths/feed/linear_program.h"

#include <algorithm>

#include "paths/feed/lasting_pieces.h"
#include "paths/feed/lift_rests.h"

namespace dwell {
namespace {

constexpr double kLeastTime = 1e-9;  // [s] below that, the ends of a piece are rounding
constexpr double kNoWay =
    1e-9;  // [mm] ends that are one place but for rounding, as where the tool is lifted in between

/// A straight step of constant acceleration.
ProgramStep accelerated(Point start, Point finish, double speed_in, double speed_out, bool removes) {
  const Point along = (1.0 / distance(start, finish)) * (finish - start);
  return {start, finish, 2.0 * distance(start, finish) / (speed_in + speed_out), removes,
          EndSpeeds{speed_in * along, speed_out * along}};
}

void add_fast_move(Program& program, const ProgramStep& step, const KinematicMove& move, double speed_in,
                   double speed_out, double least_seconds) {
  Point from = step.start;
  double travelled = 0.0;
  for (const MotionPiece& piece :
       lasting_pieces({move.length, move.acceleration, speed_in, speed_out}, move.max_speed, least_seconds)) {
    travelled += piece.length;
    const Point to = step.start + std::min(1.0, travelled / move.length) * (step.finish - step.start);
    program.steps.push_back(accelerated(from, to, piece.speed_in, piece.speed_out, step.removes));
    from = to;
  }
  program.steps.back().finish = step.finish;  // chained exactly
}

}  // namespace

Program linear_program(const StrokeMoves& moves, const KinematicPath& path, const LinearSchedule& schedule,
                       const Machine& machine, double least_seconds) {
  Program program;
  least_seconds = std::max(least_seconds, kLeastTime);
  program.fastest_feed = machine.max_feed;
  const Eigen::VectorXd settling = settling_of_strokes(moves, machine);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    ProgramStep step = moves.steps[i];
    const double in = schedule.speed[2 * i], middle = schedule.speed[2 * i + 1], out = schedule.speed[2 * i + 2];
    if (!(path.moves[i].length > 0.0)) {
      const Index j = moves.stroke[i];
      if (j != StrokeMoves::kNoStroke) step.seconds = commanded_halt(schedule.seconds[j], settling[j]);
      if (step.seconds > 0.0) program.steps.push_back(step);
    } else if (moves.stroke[i] == StrokeMoves::kNoStroke) {
      if (path.moves[i].length > kNoWay) add_fast_move(program, step, path.moves[i], in, out, least_seconds);
    } else {
      const Point half = midpoint(step.start, step.finish);
      program.steps.push_back(accelerated(step.start, half, in, middle, true));
      program.steps.push_back(accelerated(half, step.finish, middle, out, true));
    }
    if (path.stops[i + 1] != 0 && machine.corner_delay > 0.0)
      program.steps.push_back({step.finish, step.finish, machine.corner_delay, true});
  }
  return program;
}

void join_velocities(Program& program) {
  for (std::size_t i = 0; i + 1 < program.steps.size(); ++i) {
    ProgramStep &before = program.steps[i], &after = program.steps[i + 1];
    if (!before.speeds || !after.speeds) continue;
    before.speeds->out = after.speeds->in = midpoint(before.speeds->out, after.speeds->in);
  }
}

}  // namespace dwell
