#include "paths/feed/execution.h"

#include <algorithm>
#include <cmath>

#include "core/base/poll.h"
#include "core/motion/cubic_move.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/step_times.h"
#include "paths/feed/trapezoid.h"

namespace dwell {
namespace {

// A stretch of constant acceleration is cut into so many parts of equal change of speed if it begins or ends at rest,
// and into fewer where the speed changes by less.
constexpr double kPartsFromRest = 12.0;

class Runner {
 public:
  Runner(const Program& program, const Machine& machine)
      : program_(program), machine_(machine), path_(kinematic_path(program, machine)) {
    feed_ = commanded_feeds(program, path_);
    u_ = node_speeds_squared(path_, feed_);
    result_.motion = program;
    result_.motion.steps.clear();
    result_.motion.path_modes.clear();
    if (std::isfinite(machine.max_feed)) result_.motion.fastest_feed = machine.max_feed;
    for (const ProgramStep& step : program.steps) {  // what is left are the ways up
      if (is_rapid(step)) result_.motion.rapid_length -= step.length();
    }
    result_.motion.rapid_length = std::max(0.0, result_.motion.rapid_length);
  }

  Execution run(const Progress& progress) {
    Poll poll(progress);
    for (std::size_t i = 0; i < program_.steps.size(); ++i) {
      poll.step();
      result_.seconds.push_back(run_step(i) + half_rest(i) + half_rest(i + 1));
      if (path_.stops[i + 1] != 0) rest(program_.steps[i].finish);
    }
    return std::move(result_);
  }

 private:
  static bool is_rapid(const ProgramStep& step) { return !step.removes && !(step.seconds > 0.0); }

  double half_rest(std::size_t node) const { return path_.stops[node] != 0 ? 0.5 * machine_.corner_delay : 0.0; }

  void rest(Point at) {
    if (machine_.corner_delay > 0.0) result_.motion.steps.push_back({at, at, machine_.corner_delay, true});
  }

  /// Returns the seconds of the step itself.
  double run_step(std::size_t i) {
    const ProgramStep& step = program_.steps[i];
    const KinematicMove& move = path_.moves[i];
    if (!(move.length > 0.0)) {
      result_.motion.steps.push_back(step);
      return step.seconds;
    }
    const Trapezoid trapezoid{move.length, move.acceleration, std::sqrt(u_[i]), std::sqrt(u_[i + 1])};
    if (!std::isfinite(feed_[i])) {  // nothing says how fast: it takes no time
      result_.motion.steps.push_back(step);
      return 0.0;
    }
    double travelled = 0.0, seconds = 0.0;
    from_ = step.start;
    for (const MotionPiece& piece : pieces_at_feed(trapezoid, feed_[i])) {
      add_piece(step, move.length, travelled, piece);
      travelled += piece.length;
      seconds += piece.seconds();
      if (step.removes) note(piece, move.acceleration);
    }
    result_.motion.steps.back().finish = step.finish;  // chained exactly
    return seconds;
  }

  void note(const MotionPiece& piece, double acceleration) {
    result_.max_speed = std::max({result_.max_speed, piece.speed_in, piece.speed_out});
    if (piece.speed_in != piece.speed_out) result_.max_acceleration = std::max(result_.max_acceleration, acceleration);
  }

  void add_piece(const ProgramStep& step, double length, double travelled, const MotionPiece& piece) {
    const double change = std::abs(piece.speed_out - piece.speed_in);
    const double parts = std::max(1.0, std::ceil(kPartsFromRest * change / std::max(piece.speed_in, piece.speed_out)));
    const double seconds = piece.seconds() / parts;
    const double gain = (piece.speed_out - piece.speed_in) / piece.seconds();
    for (double k = 1.0; k <= parts; ++k) {
      const double t = k * seconds, along = travelled + (piece.speed_in + 0.5 * gain * t) * t;
      const Point to = step.start + std::min(1.0, along / length) * (step.finish - step.start);
      result_.motion.steps.push_back({from_, to, seconds, step.removes});
      from_ = to;
    }
  }

  const Program& program_;
  const Machine& machine_;
  KinematicPath path_;
  std::vector<double> feed_, u_;
  Point from_;
  Execution result_;
};

/// Whether a program says the speeds at the ends of its steps, as tables of position, velocity and time do.
bool says_speeds(const Program& program) {
  return std::any_of(program.steps.begin(), program.steps.end(),
                     [](const auto& step) { return step.speeds.has_value(); });
}

Execution run_as_it_stands(const Program& program) {
  Execution run;
  run.motion = program;
  for (const ProgramStep& step : program.steps) {
    run.seconds.push_back(step.seconds);
    if (!step.speeds || !step.removes) continue;
    const CubicMove move{step.start, step.finish, step.speeds->in, step.speeds->out, step.seconds};
    run.max_speed = std::max(run.max_speed, length(largest_speed(move)));
    run.max_acceleration =
        std::max({run.max_acceleration, length(move.acceleration(0.0)), length(move.acceleration(step.seconds))});
  }
  return run;
}

}  // namespace

Execution execute(const Program& program, const Machine& machine, const Progress& progress) {
  if (says_speeds(program)) return run_as_it_stands(program);
  return Runner(program, machine).run(progress);
}

}  // namespace dwell
