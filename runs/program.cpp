#include "runs/program.h"

namespace dwell {

double Program::total_seconds() const {
  double total = 0.0;
  for (const ProgramStep& step : steps) total += step.seconds;
  return total;
}

double Program::removing_length() const {
  double total = 0.0;
  for (const ProgramStep& step : steps) {
    if (step.removes) total += step.length();
  }
  return total;
}

}  // namespace dwell
