#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/form/map_statistics.h"
#include "core/motion/program.h"
#include "core/removal/exact_residual.h"
#include "paths/feed/machine.h"
#include "runs/drawing/figure_format.h"
#include "runs/logs/log_alignment.h"
#include "runs/logs/log_columns.h"
#include "runs/logs/motion_log.h"
#include "runs/plan/part.h"

namespace dwell {

/// A log and how it is to be read.
struct LogSource {
  std::string file;
  LogReading reading;
  double tolerance = kLogTolerance;  // [mm]
};

/// A program's run as a controller recorded it, beside what was commanded and what a machine was thought to make of
/// it. The three times are of the same steps, from the first that removes to the last.
struct RecordedRun {
  MotionLog log;
  AlignedLog aligned;
  MapStatistics residual;  // left by the recorded motion, form terms removed [nm]
  double change = 0.0;     // RMS of the recorded removal less the simulated one, form terms removed [nm]
  double seconds = 0.0, commanded_seconds = 0.0;
  std::optional<double> machine_seconds;  // where there is a machine
  std::vector<double> ways;               // to the middle of every step, along the path [mm]
  std::vector<double> excess;             // recorded less simulated time of every step [s]
};

/// Reads a log, lays it on the program and removes with the recorded motion: places are interpolated linearly between
/// samples, and only work counts (recorded_motion). `simulated` is what the program leaves by simulation, on the
/// machine if there is one. Throws InputError as read_motion_log and align_log, Interrupted. Cost: predict_program of
/// the samples.
RecordedRun recorded_run(const LogSource& source, const Program& program, const std::optional<Machine>& machine,
                         const Part& part, const RemovalKernel& kernel, const HeightMap& simulated,
                         const Progress& progress);

/// A figure of where the recorded run differs from the simulated one: the time of every step along the path, and its
/// sum.
std::string recorded_picture(const RecordedRun& run, const std::string& title, FigureFormat format);

/// The same in numbers, with what the log says of itself.
nlohmann::ordered_json recorded_block(const RecordedRun& run);

}  // namespace dwell
