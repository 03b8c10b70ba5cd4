#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "paths/feed/stroke_moves.h"
#include "runs/plan/part.h"

namespace dwell {

/// What logs of a path's runs have taught beyond the model of the machine.
struct LearntMotion {
  Eigen::VectorXd late;  // by how much every stroke takes longer than the machine is thought to need [s]
  HeightMap removal;     // what the recorded motion removed beyond the machine's motion with these times [nm]
  int logs = 0;          // that have taught it
};

/// A run of a program of this path, as its log tells.
struct LoggedMotion {
  Program program;              // as it was read back
  std::vector<double> seconds;  // that every step of it took; NaN where the log does not say
  Program recorded;             // the motion, at constant speed from sample to sample
};

/// What a log says beside what was expected.
struct LearntFromRun {
  LearntMotion learnt;
  double recorded_rms = 0.0;               // left by the recorded motion, about zero without form terms [nm]
  double recorded_seconds = 0.0;           // of the strokes that the log tells of
  double expected_seconds = 0.0;           // that they were thought to take
  double removal_rms = 0.0;                // of learnt.removal, without form terms [nm]
  double late_mean = 0.0, late_rms = 0.0;  // over the strokes [s]
};

/// Learns from a run: the time of every stroke beyond the machine's becomes its `late`, of a second log on half of what
/// is new (`before` holds what was expected of this run). What the recorded motion removes beyond the machine's motion
/// of these times is a correction of its own: where within a stroke the tool was slow. Method: MOTION "learning from a
/// log" in docs/motion.md. Throws InputError if the program is not of this path, Interrupted. Cost: two simulations.
LearntFromRun learn_motion(const Part& part, const StrokeMoves& moves, const Machine& machine, const LoggedMotion& run,
                           const std::optional<Eigen::VectorXd>& before, int logs_before, const Progress& progress);

/// The motion of a program on a machine with what was learnt; `learnt` null: the machine's alone.
Program learnt_execution(const Program& program, const Machine& machine, const LearntMotion* learnt,
                         const StrokeMoves& moves, const Progress& progress);

/// The part that a run with this motion seems to work on: what is learnt of the removal is taken off its map before
/// the rest is removed by simulation.
Part with_learnt_removal(Part part, const HeightMap& removal);

}  // namespace dwell
