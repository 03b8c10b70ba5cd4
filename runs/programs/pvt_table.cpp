#include "runs/programs/pvt_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/motion/cubic_move.h"
#include "runs/programs/number_text.h"

namespace dwell {
namespace {

constexpr double kTicksPerSecond = 4096e3;  // of PMAC, 1/4096 ms
constexpr double kJump = 2e-3;              // of the velocity
constexpr double kNoSpeed = 1e-6;           // [mm/s] below what files hold

double in_last_decimal(double value) { return number_of(coordinate_text(value)); }
Point in_last_decimal(Point p) { return {in_last_decimal(p.x), in_last_decimal(p.y)}; }

/// The grid of a table's numbers.
class PvtGrid {
 public:
  explicit PvtGrid(const PvtSteps& steps) : steps_(steps) {}

  bool has_clock() const { return steps_.seconds > 0.0; }
  /// The time of a tick, as the text of a file reads back.
  double time_of(std::int64_t ticks) const {
    const auto count = static_cast<double>(ticks);
    return number_of(seconds_text(has_clock() ? count * steps_.seconds : count / kTicksPerSecond));
  }
  std::int64_t ticks_of(double seconds) const {
    return std::llround(has_clock() ? seconds / steps_.seconds : seconds * kTicksPerSecond);
  }
  Point place(Point p) const { return in_last_decimal(Point{stepped(p.x), stepped(p.y)}); }

 private:
  double stepped(double value) const {
    return steps_.millimetres > 0.0 ? std::round(value / steps_.millimetres) * steps_.millimetres : value;
  }

  PvtSteps steps_;
};

Point even_speed(const ProgramStep& step) { return (1.0 / step.seconds) * (step.finish - step.start); }
Point speed_in(const ProgramStep& step) { return step.speeds ? step.speeds->in : even_speed(step); }
Point speed_out(const ProgramStep& step) { return step.speeds ? step.speeds->out : even_speed(step); }

/// The velocity between two steps, which must be nearly one.
Point speed_between(Point before, Point after, std::size_t number) {
  if (distance(before, after) <= kJump * std::max(length(before), length(after)) + kNoSpeed)
    return length(before) > 0.0 && length(after) > 0.0 ? midpoint(before, after) : Point{0.0, 0.0};
  throw InputError(fmt::format(
      "the velocity jumps after step {} of the motion, from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm/s, which no table "
      "of positions, velocities and times can say; required a machine that limits acceleration and rests at corners",
      number, before.x, before.y, after.x, after.y));
}

struct PlaceAndSpeed {
  Point place, speed;
};

/// Where a motion is a little later (or earlier, < 0) than at the end of a step, on that or on the next. At rest it
/// stays there.
PlaceAndSpeed state_near(const ProgramStep& step, const ProgramStep* next, Point speed, double late) {
  if (speed == Point{}) return {step.finish, speed};
  const ProgramStep* on = late <= 0.0 ? &step : next;
  if (on == nullptr || !on->speeds || std::abs(late) > on->seconds) return {step.finish + late * speed, speed};
  const CubicMove move{on->start, on->finish, on->speeds->in, on->speeds->out, on->seconds};
  const double t = late <= 0.0 ? on->seconds + late : late;
  return {move.place(t), move.speed(t)};
}

CubicMove cubic_of(const PvtRow& from, const PvtRow& to) {
  return {from.place, to.place, from.speed, to.speed, to.seconds - from.seconds};
}

}  // namespace

PvtTable pvt_table_of(const Program& motion, const Progress& progress, const PvtSteps& grid_steps) {
  std::vector<const ProgramStep*> steps;
  for (const ProgramStep& step : motion.steps) {
    if (step.seconds > 0.0) {
      steps.push_back(&step);
    } else if (step.start != step.finish) {
      throw InputError(fmt::format("step {} of the motion takes no time for {:.6g} mm; required one for every step",
                                   &step - motion.steps.data() + 1, step.length()));
    }
  }
  PvtTable table{{}, grid_steps};
  if (steps.empty()) return table;
  const PvtGrid grid(grid_steps);
  speed_between({}, speed_in(*steps.front()), 0);
  table.rows.push_back({0.0, grid.place(steps.front()->start), {}, true});
  Poll poll(progress);
  double seconds = 0.0;
  std::int64_t last = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    poll.step();
    const ProgramStep& step = *steps[i];
    seconds += step.seconds;
    const ProgramStep* next = i + 1 < steps.size() ? steps[i + 1] : nullptr;
    const Point speed = speed_between(speed_out(step), next != nullptr ? speed_in(*next) : Point{}, i + 1);
    const std::int64_t nearest = grid.ticks_of(seconds);
    if (grid.has_clock() && nearest <= last && speed != Point{}) continue;  // within a step of the clock
    const std::int64_t ticks = std::max(last + 1, nearest);
    const double late = grid.time_of(ticks) - seconds;
    const PlaceAndSpeed at =
        grid.has_clock() ? state_near(step, next, speed, late) : PlaceAndSpeed{step.finish + late * speed, speed};
    table.rows.push_back({grid.time_of(ticks), grid.place(at.place), in_last_decimal(at.speed), !step.removes});
    last = ticks;
  }
  return table;
}

PvtSteps pvt_steps_of(const Machine& machine) {
  return {machine.controller.time_resolution, machine.controller.position_resolution};
}

Program program_of(const PvtTable& table, const std::string& file) {
  Program program;
  program.file = file;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const PvtRow &from = table.rows[i - 1], &to = table.rows[i];
    ProgramStep step{from.place, to.place, to.seconds - from.seconds, !to.lifted, EndSpeeds{from.speed, to.speed}};
    const bool rests = from.place == to.place && from.speed == Point{} && to.speed == Point{};
    if (rests || to.untold) step.speeds.reset();
    if (step.speeds) {
      const Point most = largest_speed(cubic_of(from, to));
      program.fastest_feed = std::max(program.fastest_feed, length(most));
    }
    program.steps.push_back(step);
  }
  return program;
}

PvtTable with_steps_of_at_most(double most, const PvtTable& table) {
  PvtTable cut{{}, table.steps};
  const PvtGrid grid(table.steps);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (i > 0) {
      const PvtRow from = table.rows[i - 1], &to = table.rows[i];
      const CubicMove move = cubic_of(from, to);
      const auto parts = static_cast<std::int64_t>(std::ceil(move.seconds / most));
      const std::int64_t first = grid.ticks_of(from.seconds), all = grid.ticks_of(to.seconds) - first;
      for (std::int64_t k = 1; k < parts; ++k) {
        const std::int64_t ticks = first + all * k / parts;
        const double t = grid.time_of(ticks) - from.seconds;
        cut.rows.push_back({grid.time_of(ticks), grid.place(move.place(t)), in_last_decimal(move.speed(t)), to.lifted});
      }
    }
    cut.rows.push_back(table.rows[i]);
  }
  return cut;
}

}  // namespace dwell
