#pragma once

// Logs of a machine that is known: what execute() makes of a program, sampled as a controller does.

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/execution.h"
#include "paths/feed/kinematic_path.h"
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

/// The motion with what comes before and after it: a way to its beginning, rests, a way off.
inline std::vector<ProgramStep> whole_run(const Program& program, const Machine& machine, const LogMaking& making) {
  Machine without = machine;
  without.corner_delay = 0.0;
  const Execution run = execute(program, without);
  const KinematicPath path = kinematic_path(program, machine);
  const Point first = run.motion.steps.front().start, last = run.motion.steps.back().finish;
  std::vector<ProgramStep> steps{{first + Point{-7.0, 4.0}, first + Point{-7.0, 4.0}, 0.3},
                                 {first + Point{-7.0, 4.0}, first, 0.61},
                                 {first, first, 0.2}};
  std::size_t piece = 0;
  double since_stop = 0.0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    double left = run.seconds[i];
    while (piece < run.motion.steps.size() && left > 1e-9 * run.seconds[i]) {
      steps.push_back(run.motion.steps[piece++]);
      left -= steps.back().seconds;
      since_stop += steps.back().seconds;
    }
    const Point at = program.steps[i].finish;
    if (making.block > 0.0) steps.push_back({at, at, making.block});
    if (path.stops[i + 1] == 0) continue;
    double rest = machine.corner_delay;
    if (making.servo > 0.0) {
      const double whole = std::ceil((since_stop + rest) / making.servo) * making.servo;
      rest = whole - since_stop;
    }
    if (rest > 0.0) steps.push_back({at, at, rest});
    since_stop = 0.0;
  }
  steps.push_back({last, last, 0.25});
  steps.push_back({last, last + Point{3.0, 11.0}, 0.9});
  return steps;
}

inline MotionLog made_up_log(const Program& program, const Machine& machine, const LogMaking& making = {}) {
  MotionLog log;
  log.file = "made-up.csv";
  log.period = making.period;
  std::mt19937 random(making.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  double begin = 0.0;
  long sample = 0;
  for (const ProgramStep& step : whole_run(program, machine, making)) {
    for (; static_cast<double>(sample) * making.period < begin + step.seconds; ++sample) {
      const double t = static_cast<double>(sample) * making.period;
      Point at = step.start + ((t - begin) / step.seconds) * (step.finish - step.start);
      if (making.noise > 0.0) at = at + making.noise * Point{noise(random), noise(random)};
      log.seconds.push_back(making.begins + making.clock * t);
      log.places.push_back(at);
    }
    begin += step.seconds;
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
