#include "paths/feed/block_check.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/base/counted.h"
#include "paths/feed/step_times.h"

namespace dwell {

std::optional<std::string> short_blocks(const Program& program, const Machine& machine) {
  const double rate = machine.controller.max_blocks_per_s;
  if (!std::isfinite(rate)) return std::nullopt;
  constexpr double kRounding = 1e-6, kTick = 2.5e-7;  // relative, of feeds; [s] of times in files
  const double least = 1.0 / rate, accepted = least * (1.0 - kRounding) - kTick;
  const std::vector<double> seconds = step_times(program, machine);
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    if (!program.steps[i].removes || !(seconds[i] < accepted)) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return std::nullopt;
  return fmt::format(
      "{} of the program {} shorter than the {:.4g} ms that the controller takes for a block ({:.6g} blocks/s): the "
      "first is step {}, of {:.4g} ms",
      counted(count, "step"), count == 1 ? "is" : "are", 1e3 * least, rate, first + 1, 1e3 * seconds[first]);
}

}  // namespace dwell
