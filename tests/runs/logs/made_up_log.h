#pragma once

// Logs of a machine that is known: its trapezoids of speed, sampled as a controller does.

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/step_times.h"
#include "paths/feed/trapezoid.h"
#include "runs/logs/motion_log.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell::test {

struct LogMaking {
  double period = 1e-3;  // [s]
  double noise = 0.0;    // of each place and axis [mm]
  double servo = 0.0;    // every run from stop to stop lasts until the next multiple of this [s]; 0: as it is
  double clock = 1.0;    // the log's seconds a true one
  double block = 0.0;    // rest at the end of every step [s]
  unsigned seed = 4;
  double begins = 3.1234;  // time of the first sample [s]
};

/// A stretch at constant acceleration.
struct RunPiece {
  Point start, finish;
  double seconds = 0.0, speed_in = 0.0, speed_out = 0.0;  // [mm/s]

  Point place(double t) const {
    const double whole = distance(start, finish);
    if (!(whole > 0.0)) return start;
    const double way = (speed_in + 0.5 * (speed_out - speed_in) / seconds * t) * t;
    return start + (way / whole) * (finish - start);
  }
};

/// The motion with what comes before and after it: a way to its beginning, rests, a way off.
inline std::vector<RunPiece> whole_run(const Program& program, const Machine& machine, const LogMaking& making) {
  const KinematicPath path = kinematic_path(program, machine);
  const std::vector<double> feeds = commanded_feeds(program, path), u = node_speeds_squared(path, feeds);
  const Point first = program.steps.front().start, last = program.steps.back().finish;
  std::vector<RunPiece> pieces;
  const auto rest = [&pieces](Point at, double seconds) { pieces.push_back({at, at, seconds}); };
  const auto run = [&pieces](Point from, Point to, double in, double out) {
    pieces.push_back({from, to, 2.0 * distance(from, to) / (in + out), in, out});
  };
  rest(first + Point{-7.0, 4.0}, 0.3);
  run(first + Point{-7.0, 4.0}, first, 11.0, 15.0);
  rest(first, 0.2);
  double since_stop = 0.0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    const KinematicMove& move = path.moves[i];
    if (!(move.length > 0.0)) rest(step.finish, step.seconds), since_stop += step.seconds;
    double way = 0.0;
    for (const MotionPiece& piece :
         move.length > 0.0
             ? pieces_at_feed({move.length, move.acceleration, std::sqrt(u[i]), std::sqrt(u[i + 1])}, feeds[i])
             : std::vector<MotionPiece>{}) {
      const auto at = [&](double w) { return step.start + (w / move.length) * (step.finish - step.start); };
      run(at(way), at(way + piece.length), piece.speed_in, piece.speed_out);
      way += piece.length;
      since_stop += pieces.back().seconds;
    }
    if (making.block > 0.0) rest(step.finish, making.block);
    if (path.stops[i + 1] == 0) continue;
    double pause = machine.corner_delay;
    if (making.servo > 0.0) pause = std::ceil((since_stop + pause) / making.servo) * making.servo - since_stop;
    if (pause > 0.0) rest(step.finish, pause);
    since_stop = 0.0;
  }
  rest(last, 0.25);
  run(last, last + Point{3.0, 11.0}, 15.0, 11.0);
  return pieces;
}

inline MotionLog made_up_log(const Program& program, const Machine& machine, const LogMaking& making = {}) {
  MotionLog log;
  log.file = "made-up.csv";
  log.period = making.period;
  std::mt19937 random(making.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  double begin = 0.0;
  long sample = 0;
  for (const RunPiece& piece : whole_run(program, machine, making)) {
    for (; static_cast<double>(sample) * making.period < begin + piece.seconds; ++sample) {
      const double t = static_cast<double>(sample) * making.period;
      Point at = piece.place(t - begin);
      if (making.noise > 0.0) at = at + making.noise * Point{noise(random), noise(random)};
      log.seconds.push_back(making.begins + making.clock * t);
      log.places.push_back(at);
    }
    begin += piece.seconds;
  }
  return log;
}

/// A program that turns at every node.
inline Program crooked_program(unsigned seed, int moves, double slowest = 1.0, double fastest = 20.0) {
  return {"crooked.nc", crooked_chain(seed, moves, slowest, fastest)};
}

/// The log as text with these columns.
inline std::string log_text(const MotionLog& log, const std::string& header, double time_unit = 1.0,
                            double place_unit = 1.0, char mark = ',') {
  std::string text = header + "\n";
  for (std::size_t i = 0; i < log.size(); ++i) {
    char line[120];
    std::snprintf(line, sizeof line, "%.9g%c%.9g%c%.9g\n", log.seconds[i] / time_unit, mark,
                  log.places[i].x / place_unit, mark, log.places[i].y / place_unit);
    text += line;
  }
  return text;
}

}  // namespace dwell::test
