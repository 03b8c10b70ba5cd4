#include "paths/feed/step_times.h"

#include <algorithm>
#include <cmath>

namespace dwell {

std::vector<double> commanded_feeds(const Program& program, const KinematicPath& path) {
  std::vector<double> feeds;
  feeds.reserve(program.steps.size());
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    const double most = path.moves[i].max_speed;
    if (step.seconds > 0.0) {
      feeds.push_back(std::min(most, step.length() / step.seconds));
    } else {
      feeds.push_back(std::isfinite(most) || !(program.fastest_feed > 0.0) ? most : program.fastest_feed);
    }
  }
  return feeds;
}

std::vector<double> step_times(const Program& program, const Machine& machine) {
  std::vector<double> seconds;
  seconds.reserve(program.steps.size());
  if (std::any_of(program.steps.begin(), program.steps.end(),
                  [](const auto& step) { return step.speeds.has_value(); })) {
    for (const ProgramStep& step : program.steps) seconds.push_back(step.seconds);
    return seconds;
  }
  const KinematicPath path = kinematic_path(program, machine);
  const std::vector<double> feeds = commanded_feeds(program, path);
  const std::vector<double> u = node_speeds_squared(path, feeds);
  const auto half_rest = [&](std::size_t node) { return path.stops[node] != 0 ? 0.5 * machine.corner_delay : 0.0; };
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const KinematicMove& move = path.moves[i];
    double own = program.steps[i].seconds;
    if (move.length > 0.0) {
      own = std::isfinite(feeds[i]) ? move_parts(path, i, feeds[i], u[i], u[i + 1]).seconds(feeds[i]) : 0.0;
    }
    seconds.push_back(own + half_rest(i) + half_rest(i + 1));
  }
  return seconds;
}

}  // namespace dwell
