#include "core/motion/program.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

bool same_step(const ProgramStep& a, const ProgramStep& b, double max_feed) {
  constexpr double kPlace = 1e-6, kDuration = 1e-6, kLength = 4e-6,
                   kSpeed = 1e-6;  // [mm], relative, [mm]: see dwell_within_feed
  if (a.speeds.has_value() != b.speeds.has_value()) return false;
  if (a.speeds && !(distance(a.speeds->in, b.speeds->in) <= kSpeed * max_feed &&
                    distance(a.speeds->out, b.speeds->out) <= kSpeed * max_feed)) {
    return false;
  }
  return std::abs(a.seconds - b.seconds) <= kDuration * std::min(a.seconds, b.seconds) + kLength / max_feed &&
         distance(a.start, b.start) <= kPlace && distance(a.finish, b.finish) <= kPlace;
}

}  // namespace

double Program::total_seconds() const {
  double total = 0.0;
  for (const ProgramStep& step : steps) total += step.seconds;
  return total;
}

double Program::rapid_seconds(std::optional<double> feed) const {
  const double speed = feed.value_or(fastest_feed);
  return speed > 0.0 ? rapid_length / speed : 0.0;
}

double Program::removing_length() const {
  double total = 0.0;
  for (const ProgramStep& step : steps) {
    if (step.removes) total += step.length();
  }
  return total;
}

bool same_removing_steps(const Program& a, const Program& b, double max_feed) {
  const auto removes = [](const ProgramStep& step) { return step.removes; };
  auto i = a.steps.begin(), j = b.steps.begin();
  while (true) {
    i = std::find_if(i, a.steps.end(), removes);
    j = std::find_if(j, b.steps.end(), removes);
    if (i == a.steps.end() || j == b.steps.end()) return i == a.steps.end() && j == b.steps.end();
    if (!same_step(*i++, *j++, max_feed)) return false;
  }
}

}  // namespace dwell
