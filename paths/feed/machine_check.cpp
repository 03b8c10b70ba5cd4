#include "paths/feed/machine_check.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/counted.h"
#include "core/base/units.h"
#include "paths/feed/block_check.h"
#include "paths/feed/cubic_check.h"

namespace dwell {
namespace {

// Feeds in files are rounded down; what a reader makes of them is above by no more than this.
constexpr double kRoundingOfFeeds = 1e-6;

/// The first of some steps, and how many there are.
struct Found {
  std::size_t first = 0, count = 0;

  void add(std::size_t step) {
    if (count == 0) first = step;
    ++count;
  }
};

bool is_outside(const MachineAxis& axis, double place) { return place < axis.lowest || place > axis.highest; }

void check_axis(const char* name, const MachineAxis& axis, const Program& program, const ProgramFrame& frame,
                double Point::*component, std::vector<std::string>& faults) {
  Found found;
  double where = 0.0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    for (const Point place : {program.steps[i].start, program.steps[i].finish}) {
      const Point p = frame.to_program(place);
      if (!is_outside(axis, p.*component)) continue;
      if (found.count == 0) where = p.*component;
      found.add(i);
      break;
    }
  }
  if (found.count == 0) return;
  faults.push_back(
      fmt::format("{} of the program {} the machine's travel of {} from {:.6g} to {:.6g} mm: the first is "
                  "step {}, at {} = {:.6g} mm",
                  counted(found.count, "step"), found.count == 1 ? "leaves" : "leave", name, axis.lowest, axis.highest,
                  found.first + 1, name, where));
}

}  // namespace

std::vector<std::string> beyond_machine(const Program& program, const Machine& of_part) {
  const Machine machine = machine_on(of_part, program);
  std::vector<std::string> faults;
  check_axis("x", machine.x, program, machine.frame, &Point::x, faults);
  check_axis("y", machine.y, program, machine.frame, &Point::y, faults);
  Found fast, slow;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    if (!step.removes || step.speeds || !(step.length() > 0.0)) continue;
    const double feed = step.length() / step.seconds;
    if (feed > speed_limit(machine, step.finish - step.start) * (1.0 + kRoundingOfFeeds)) fast.add(i);
    if (feed < machine.min_feed * (1.0 - kRoundingOfFeeds)) slow.add(i);
  }
  const auto say = [&](const Found& found, const char* than, double limit) {
    if (found.count == 0) return;
    const ProgramStep& step = program.steps[found.first];
    faults.push_back(
        fmt::format("{} of the program {} {} than the machine: the first is step {}, at {:.6g} mm/min where "
                    "the limit is {:.6g} mm/min",
                    counted(found.count, "step"), found.count == 1 ? "is" : "are", than, found.first + 1,
                    units::mm_per_min(step.length() / step.seconds), units::mm_per_min(limit)));
  };
  const ProgramStep* first = fast.count > 0 ? &program.steps[fast.first] : nullptr;
  say(fast, "faster", first != nullptr ? speed_limit(machine, first->finish - first->start) : 0.0);
  say(slow, "slower", machine.min_feed);
  if (auto fault = short_blocks(program, of_part)) faults.push_back(std::move(*fault));
  for (std::string& fault : cubics_beyond_machine(program, machine)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace dwell
