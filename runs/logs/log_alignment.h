#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/logs/motion_log.h"
#include "runs/logs/node_times.h"

namespace dwell {

/// A log laid on the program that it is of.
struct AlignedLog {
  std::size_t first = 0, end = 0;  // steps of the program: from the first that removes to behind the last
  std::vector<NodeTime> nodes;     // end - first + 1: of the beginning of each, and of the end of the last
  std::vector<char> corners;       // of each node: it is an end of the run, a halt, a lift, or the path turns there
  std::vector<char> gaps;          // of each step: samples are missing in it
  std::size_t before = 0, within = 0, after = 0;  // samples: before the run, in it, and after it
  double tolerance = 0.0;                         // of the distance from the path [mm]
  double rms_off = 0.0;                           // distance of the samples at work from the path [mm]
  double max_off = 0.0;

  double begins() const { return nodes.front().leaves; }
  double ends() const { return nodes.back().arrives; }
  double seconds() const { return ends() - begins(); }  // of the run
  /// Of a step of the program, from node to node [s].
  double step_seconds(std::size_t step) const { return nodes[step - first + 1].passes - nodes[step - first].passes; }
};

/// What samples may be off the path at most, unless the user says otherwise [mm].
inline constexpr double kLogTolerance = 0.1;

/// Finds the run of a program in a log, which may begin before it and end after it, and the time at every node, by the
/// way along the path: between two samples that is interpolated, corners get the middle of the pause at them, halts
/// their time about the middle of it. Samples at work lie within `tolerance` [mm] of the path, but for five in a row at
/// most; on lifted moves they may lie anywhere. Throws InputError for a program that removes nothing, and for a log of
/// another path, which says where and how far off it is, and which exchange, reversal or factor of its axes would make
/// it fit; Interrupted. Cost O(samples + steps), for a log that does not fit a few times that.
AlignedLog align_log(const MotionLog& log, const Program& program, double tolerance = kLogTolerance,
                     const Progress& progress = {});

/// Where a log of a program that was stopped ends on its path.
struct LogEnd {
  std::size_t step = 0;  // of the program
  double share = 0.0;    // of that step's length that was run
  Point place;           // on the path [mm]
};

/// The end of a log that begins as align_log has it and ends on the path, or leaves it from a place where the tool
/// rested before (it was lifted and taken away). Throws InputError for a program that removes nothing, for a log of
/// another path, and for one that has run the program to its end; Interrupted. Cost as align_log.
LogEnd end_of_log(const MotionLog& log, const Program& program, double tolerance = kLogTolerance,
                  const Progress& progress = {});

/// The motion as recorded, as steps at constant speed from sample to sample while the tool is at work: it is so between
/// the beginning and the end of each row of steps that remove. Rests at their ends, in which it is lifted or lowered,
/// count as lifted.
Program recorded_motion(const MotionLog& log, const AlignedLog& aligned, const Program& program);

}  // namespace dwell
