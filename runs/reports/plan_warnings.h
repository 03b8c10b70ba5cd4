#pragma once

#include <string>
#include <vector>

namespace dwell {

/// What a machine shop would question of a run.
struct RunFigures {
  double total_s = 0.0;             // lifted moves included
  double removing_s = 0.0;          // with the tool at work
  double removing_length_mm = 0.0;  // 0 where the tool only halts
};

/// Sentences about a run of over a day, or at a mean feed below 1 mm/min, each with what would shorten it and with
/// options between backquotes; mostly none. No limit is reached by them.
std::vector<std::string> run_warnings(const RunFigures& run);

}  // namespace dwell
