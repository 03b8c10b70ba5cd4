#include "runs/reports/plan_warnings.h"

#include <fmt/format.h>

#include "core/base/duration_text.h"
#include "core/base/units.h"

namespace dwell {

std::vector<std::string> run_warnings(const RunFigures& run) {
  constexpr double kLongRun = 24.0 * 3600.0, kSlowFeed = 1.0;  // s, mm/min
  constexpr const char* kShorter =
      "a removal function of a higher rate shortens it, or less to remove: more form terms in `remove`, a smaller "
      "`aperture`, a `time price` above 0";
  std::vector<std::string> warnings;
  if (run.total_s > kLongRun) {
    warnings.push_back(fmt::format("the run takes {}, over 24 h: {}", clock_text(run.total_s), kShorter));
  }
  const double feed = run.removing_s > 0.0 ? units::mm_per_min(run.removing_length_mm / run.removing_s) : kSlowFeed;
  if (run.removing_length_mm > 0.0 && feed < kSlowFeed) {
    warnings.push_back(
        fmt::format("the mean feed is {:.3g} mm/min, below 1 mm/min, which machines rarely hold "
                    "evenly: {}",
                    feed, kShorter));
  }
  return warnings;
}

}  // namespace dwell
