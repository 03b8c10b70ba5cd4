#include "paths/feed/execution.h"

#include <algorithm>
#include <cmath>

#include "core/base/poll.h"
#include "core/motion/cubic_move.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/step_times.h"
#include "paths/feed/trapezoid.h"

namespace dwell {
namespace {

// A stretch of constant acceleration is cut into so many parts of equal change of speed if it begins or ends at rest,
// and into fewer where the speed changes by less.
constexpr double kPartsFromRest = 12.0;
// Arcs are run as chords, each in its exact time, that lie beside them by no more than this; and where the acceleration
// changes evenly, places between nodes are those of constant acceleration within this.
constexpr double kChordWithin = 1e-4;  // [mm]

class Runner {
 public:
  /// `nodes`: where they are wanted.
  Runner(const Program& program, const Machine& machine, MotionNodes* nodes)
      : program_(program),
        machine_(machine),
        nodes_(nodes),
        lifts_(program, machine),
        path_(kinematic_path(program, machine)) {
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
      for (const ProgramStep& at_lift : lifts_.before(i)) {
        result_.at_lifts.push_back(result_.motion.steps.size());
        keep_step(at_lift);
      }
      result_.seconds.push_back(run_step(i) + half_rest(i) + half_rest(i + 1));
      if (path_.stops[i + 1] != 0) rest(program_.steps[i].finish);
    }
    return std::move(result_);
  }

 private:
  static bool is_rapid(const ProgramStep& step) { return !step.removes && !(step.seconds > 0.0); }

  double half_rest(std::size_t node) const { return path_.stops[node] != 0 ? 0.5 * machine_.corner_delay : 0.0; }

  void rest(Point at) {
    if (!(machine_.corner_delay > 0.0)) return;
    result_.motion.steps.push_back({at, at, machine_.corner_delay, true});
    if (nodes_ != nullptr) nodes_->rest(at, machine_.corner_delay, true);
  }

  /// A step at one speed, or at rest.
  void keep_step(const ProgramStep& step) {
    result_.motion.steps.push_back(step);
    if (nodes_ == nullptr) return;
    if (!(step.length() > 0.0)) return nodes_->rest(step.start, step.seconds, step.removes);
    nodes_->run(step.start, step.finish, 0.0, 0.0, step.seconds, step.removes);
  }

  /// Returns the seconds of the step itself.
  double run_step(std::size_t i) {
    const ProgramStep& step = program_.steps[i];
    const KinematicMove& move = path_.moves[i];
    if (!(move.length > 0.0)) {
      keep_step(step);
      return step.seconds;
    }
    if (!std::isfinite(feed_[i])) {  // nothing says how fast: it takes no time
      keep_step(step);
      return 0.0;
    }
    const BlendArc none;
    const BlendArc& in = path_.arcs.empty() ? none : path_.arcs[i];
    const BlendArc& out = path_.arcs.empty() ? none : path_.arcs[i + 1];
    const BlendedStep way(step, in, out);
    double travelled = 0.0, seconds = 0.0;
    if (!(in.radius > 0.0)) from_ = step.start;
    move_parts(path_, i, feed_[i], u_[i], u_[i + 1]).for_each([&](const Trapezoid& part, std::size_t which) {
      for (const MotionPiece& piece : pieces_at_feed(part, feed_[i])) {
        if (which == 1) {
          add_straight(step, way, travelled, piece);
        } else {
          add_arc(step, way, which == 0 ? in.radius : out.radius, travelled, piece);
        }
        travelled += piece.length;
        seconds += piece.seconds();
        if (step.removes) note(piece, part.acceleration);
      }
    });
    if (!(out.radius > 0.0)) result_.motion.steps.back().finish = step.finish;  // chained exactly
    return seconds;
  }

  void note(const MotionPiece& piece, double acceleration) {
    result_.max_speed = std::max({result_.max_speed, piece.speed_in, piece.speed_out});
    if (piece.jerk != 0.0) {
      const double in = piece.acceleration_in(), out = in + piece.jerk * piece.seconds();
      result_.max_acceleration = std::max({result_.max_acceleration, std::abs(in), std::abs(out)});
      return;
    }
    if (piece.speed_in != piece.speed_out) result_.max_acceleration = std::max(result_.max_acceleration, acceleration);
  }

  /// At constant jerk j, a part of T seconds that counts as one of constant acceleration is off by j T^3 / 12 at most.
  static double parts_of(const MotionPiece& piece) {
    const double change = std::abs(piece.speed_out - piece.speed_in);
    const double bent = piece.seconds() * std::cbrt(std::abs(piece.jerk) / (12.0 * kChordWithin));
    return std::max(
        {1.0, std::ceil(kPartsFromRest * change / std::max(piece.speed_in, piece.speed_out)), std::ceil(bent)});
  }

  /// A piece in so many parts of equal time; `after`(s, v, seconds) is told the end of each.
  template <class After>
  static void cut(const MotionPiece& piece, double parts, const After& after) {
    const double seconds = piece.seconds() / parts;
    for (double k = 1.0; k <= parts; ++k) after(piece.way(k * seconds), piece.speed(k * seconds), seconds);
  }

  void add_straight(const ProgramStep& step, const BlendedStep& way, double travelled, const MotionPiece& piece) {
    const Point begin = from_;
    const bool bent = piece.jerk != 0.0;  // then every part is a stretch of its own for the nodes
    double before = piece.speed_in;
    cut(piece, parts_of(piece), [&](double s, double v, double seconds) {
      const Point to = way.place(std::min(way.length(), travelled + s));
      result_.motion.steps.push_back({from_, to, seconds, step.removes});
      if (bent && nodes_ != nullptr) nodes_->run(from_, to, before, v, seconds, step.removes);
      from_ = to;
      before = v;
    });
    if (!bent && nodes_ != nullptr)
      nodes_->run(begin, from_, piece.speed_in, piece.speed_out, piece.seconds(), step.removes);
  }

  void add_arc(const ProgramStep& step, const BlendedStep& way, double radius, double travelled,
               const MotionPiece& piece) {
    // A chord of the angle b lies beside its arc by R (1 - cos(b / 2)) < R b^2 / 8. Parts of equal time are up to twice
    // as long as their mean where the speed changes.
    const double uneven = 2.0 * std::max(piece.speed_in, piece.speed_out) / (piece.speed_in + piece.speed_out);
    const double chords = std::ceil(uneven * piece.length / std::sqrt(8.0 * kChordWithin * radius));
    double before = piece.speed_in;
    cut(piece, std::max(chords, parts_of(piece)), [&](double s, double v, double seconds) {
      const Point to = way.place(std::min(way.length(), travelled + s));
      result_.motion.steps.push_back({from_, to, seconds, step.removes});
      if (nodes_ != nullptr) nodes_->run(from_, to, before, v, seconds, step.removes);
      from_ = to;
      before = v;
    });
  }

  const Program& program_;
  const Machine& machine_;
  MotionNodes* nodes_;
  LiftRests lifts_;
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

Execution run_as_it_stands(const Program& program, const Machine& machine) {
  Execution run;
  run.motion = with_lift_rests(program, machine);
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

void add_as_it_stands(const Program& program, const Machine& machine, MotionNodes& nodes) {
  for (const ProgramStep& step : with_lift_rests(program, machine).steps) {
    if (!step.speeds) {
      const double speed = step.seconds > 0.0 ? step.length() / step.seconds : 0.0;
      nodes.run(step.start, step.finish, speed, speed, step.seconds, step.removes);
      continue;
    }
    const CubicMove move{step.start, step.finish, step.speeds->in, step.speeds->out, step.seconds};
    const std::vector<Point> places = places_on(move, kPartsFromRest);
    const double part = step.seconds / static_cast<double>(places.size() - 1);
    for (std::size_t k = 1; k < places.size(); ++k) {
      const double begin = part * static_cast<double>(k - 1), end = part * static_cast<double>(k);
      nodes.run(places[k - 1], places[k], length(move.speed(begin)), length(move.speed(end)), part, step.removes);
    }
  }
}

}  // namespace

Execution execute(const Program& program, const Machine& machine, const Progress& progress) {
  if (says_speeds(program)) return run_as_it_stands(program, machine);
  return Runner(program, machine, nullptr).run(progress);
}

std::vector<MotionNode> motion_nodes(const Program& program, const Machine& machine, const Progress& progress) {
  MotionNodes nodes;
  if (says_speeds(program)) {
    add_as_it_stands(program, machine, nodes);
  } else {
    Runner(program, machine, &nodes).run(progress);
  }
  return nodes.take();
}

}  // namespace dwell
