#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/motion/program.h"
#include "runs/logs/log_alignment.h"

namespace dwell {

/// A run from one corner to the next.
struct LoggedRun {
  std::size_t first = 0, end = 0;  // steps of the program
  double seconds = 0.0;            // from the middle of one corner's pause to that of the next, as logged

  std::size_t steps() const { return end - first; }
};

struct LoggedRuns {
  std::vector<LoggedRun> runs;
  std::size_t gaps = 0;    // runs left out because samples are missing in them
  std::size_t lifted = 0;  // because the tool is lifted in or beside them, or because the program halts in them
};

/// The runs of an aligned log, but for the first and the last, of which one end is not known: when the motion began
/// and ended there.
LoggedRuns logged_runs(const AlignedLog& aligned, const Program& program);

/// The sum over a run's steps.
double run_seconds(const LoggedRun& run, std::span<const double> step_seconds);

}  // namespace dwell
