#include "runs/logs/logged_runs.h"

namespace dwell {

LoggedRuns logged_runs(const AlignedLog& aligned, const Program& program) {
  LoggedRuns found;
  std::size_t begin = aligned.first;
  for (std::size_t i = aligned.first; i < aligned.end; ++i) {
    if (aligned.corners[i + 1 - aligned.first] == 0) continue;
    const LoggedRun run{begin, i + 1,
                        aligned.nodes[i + 1 - aligned.first].passes - aligned.nodes[begin - aligned.first].passes};
    const bool at_an_end = begin == aligned.first || i + 1 == aligned.end;
    begin = i + 1;
    // Beside a lift, too, one end is not known.
    const auto is_lift = [&](std::size_t step) { return step < program.steps.size() && !program.steps[step].removes; };
    bool lifted = is_lift(run.end) || (run.first > 0 && is_lift(run.first - 1)), gap = false;
    for (std::size_t k = run.first; k < run.end; ++k) {
      lifted = lifted || is_lift(k) || !(program.steps[k].length() > 0.0);
      gap = gap || aligned.gaps[k - aligned.first] != 0;
    }
    if (at_an_end) continue;
    found.lifted += static_cast<std::size_t>(lifted);
    found.gaps += static_cast<std::size_t>(gap && !lifted);
    if (!lifted && !gap) found.runs.push_back(run);
  }
  return found;
}

double run_seconds(const LoggedRun& run, std::span<const double> step_seconds) {
  double sum = 0.0;
  for (std::size_t k = run.first; k < run.end; ++k) sum += step_seconds[k];
  return sum;
}

}  // namespace dwell
