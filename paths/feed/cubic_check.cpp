#include "paths/feed/cubic_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/counted.h"
#include "core/motion/cubic_move.h"

namespace dwell {
namespace {

constexpr double kCubicTolerance = 1e-6;
constexpr double kSameSpeed = 1e-6;  // [mm/s] the last digit of files
constexpr int kSamples = 32;         // of a bent cubic, for its speed along the path

/// One kind of limit: the steps that are beyond it.
struct Beyond {
  const char* what;
  const char* unit;
  double limit;
  std::size_t first = 0, count = 0;
  double reached = 0.0;  // the most, of all steps

  void check(std::size_t step, double value) {
    if (value <= limit * (1.0 + kCubicTolerance)) return;
    if (count == 0) first = step;
    ++count;
    reached = count == 1 || !(value <= reached) ? value : reached;
  }

  std::string sentence() const {
    return fmt::format(
        "{} of the program {} the machine's {}: the first is step {}, the most {:.6g} {} where the "
        "limit is {:.6g} {}",
        counted(count, "step"), count == 1 ? "exceeds" : "exceed", what, first + 1, reached, unit, limit, unit);
  }
};

/// The jerks of a row of cubics: inside of each, and where its acceleration jumps, by what that would be if the shorter
/// of both took it up.
class JerkCheck {
 public:
  explicit JerkCheck(const Machine& machine)
      : of_x_{"jerk of x", "mm/s^3", machine.x.max_jerk},
        of_y_{"jerk of y", "mm/s^3", machine.y.max_jerk},
        of_path_{"jerk along the path", "mm/s^3", machine.path_jerk},
        checks_(limits_jerk(machine)) {}

  void take(std::size_t step, const CubicMove& move) {
    if (!checks_) return;
    const Point in = move.acceleration(0.0), out = move.acceleration(move.seconds);
    check(step, (1.0 / move.seconds) * (out - in));
    check(step, (1.0 / std::min(move.seconds, before_s_)) * (in - before_));
    before_ = out, before_s_ = move.seconds;
  }
  /// The tool rests before this step.
  void rest(std::size_t step) {
    if (checks_ && before_s_ < kLong) check(step, (1.0 / before_s_) * before_);
    before_ = {}, before_s_ = kLong;
  }
  void add_to(std::vector<std::string>& faults) const {
    for (const Beyond* beyond : {&of_x_, &of_y_, &of_path_}) {
      if (beyond->count > 0) faults.push_back(beyond->sentence());
    }
  }

 private:
  static constexpr double kLong = std::numeric_limits<double>::infinity();

  void check(std::size_t step, Point jerk) {
    of_x_.check(step, std::abs(jerk.x));
    of_y_.check(step, std::abs(jerk.y));
    of_path_.check(step, length(jerk));
  }

  Beyond of_x_, of_y_, of_path_;
  bool checks_;
  Point before_;
  double before_s_ = kLong;
};

/// The largest speed along the path; `bound` if that is within the limit anyhow.
double path_speed(const CubicMove& move, double bound, double limit) {
  if (bound <= limit) return bound;
  double most = std::max(length(move.speed_in), length(move.speed_out));
  for (int k = 1; k < kSamples; ++k) most = std::max(most, length(move.speed(move.seconds * k / kSamples)));
  return most;
}

}  // namespace

std::vector<std::string> cubics_beyond_machine(const Program& program, const Machine& machine) {
  Beyond all[] = {{"speed of x", "mm/s", machine.x.max_speed},
                  {"speed of y", "mm/s", machine.y.max_speed},
                  {"speed along the path", "mm/s", machine.max_feed},
                  {"acceleration of x", "mm/s^2", machine.x.max_acceleration},
                  {"acceleration of y", "mm/s^2", machine.y.max_acceleration},
                  {"acceleration along the path", "mm/s^2", machine.path_acceleration},
                  {"continuous velocity (a jump)", "mm/s", kSameSpeed}};
  JerkCheck jerks(machine);
  Point speed;        // before the step
  bool known = true;  // unless a step does not say it
  bool any = false;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    const bool rests = !step.speeds && step.start == step.finish;
    if (!step.speeds) jerks.rest(i);
    if (!step.speeds && !rests) {
      known = !step.removes;  // at the ends of a lifted way the tool rests
      speed = {};
      continue;
    }
    const EndSpeeds ends = step.speeds.value_or(EndSpeeds{});
    if (known) all[6].check(i, distance(speed, ends.in));
    speed = ends.out;
    known = true;
    if (!step.speeds) continue;
    any = true;
    const ProgramFrame& frame = machine.frame;  // the axes are the program's
    const CubicMove move{frame.to_program(step.start), frame.to_program(step.finish),
                         frame.direction_to_program(ends.in), frame.direction_to_program(ends.out), step.seconds};
    jerks.take(i, move);
    const Point v = largest_speed(move), a = largest_acceleration(move);
    all[0].check(i, v.x);
    all[1].check(i, v.y);
    all[2].check(i, path_speed(move, length(v), machine.max_feed));
    all[3].check(i, a.x);
    all[4].check(i, a.y);
    all[5].check(i, std::max(length(move.acceleration(0.0)), length(move.acceleration(step.seconds))));
  }
  if (any && known) all[6].check(program.steps.size() - 1, length(speed));
  std::vector<std::string> faults;
  if (!any) return faults;
  jerks.rest(program.steps.size() - 1);
  for (const Beyond& beyond : all) {
    if (beyond.count > 0) faults.push_back(beyond.sentence());
  }
  jerks.add_to(faults);
  return faults;
}

}  // namespace dwell
