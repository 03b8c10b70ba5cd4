#include "paths/feed/end_feed_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/poll.h"

namespace dwell {
namespace {

constexpr double kStraightWay = 1e-9;       // of a way, by which it may be longer than the straight one
constexpr double kNoSpeed = 1e-6;           // [mm/s] less is rest
constexpr double kConstant = 1e-6;          // of a time, by which a step of constant acceleration may be off
constexpr double kDirection = 1e-6;         // of a speed, likewise across the step
constexpr double kRoundedDirection = 2e-3;  // what rounding of places to 1e-6 mm makes of the shortest steps

[[noreturn]] void refuse(std::size_t step, const char* what) {
  throw InputError(fmt::format(
      "`export`: step {} of the motion {}, which no feed at the end of a block can say; required `schedule` "
      "= linear or constant",
      step + 1, what));
}

/// The speed of a velocity along a direction of length 1.
double speed_along(Point velocity, Point along, std::size_t step) {
  const double speed = velocity.x * along.x + velocity.y * along.y;
  const double most = length(velocity);
  if (distance(velocity, speed * along) > kDirection * most + kNoSpeed) refuse(step, "is bent");
  if (speed < -kNoSpeed) refuse(step, "runs backwards");
  return most <= kNoSpeed ? 0.0 : most;
}

EndFeedBlock moving_block(const ProgramStep& step, std::size_t number) {
  if (!step.speeds) refuse(number, "says no speeds");
  const double length = step.length();
  const Point along = (1.0 / length) * (step.finish - step.start);
  EndFeedBlock block{step.start, step.finish};
  block.speed_in = speed_along(step.speeds->in, along, number);
  block.speed_out = speed_along(step.speeds->out, along, number);
  // By the speeds as they are: one that counts as rest may be a share of a slow one beside it.
  const double seconds = 2.0 * length / (dwell::length(step.speeds->in) + dwell::length(step.speeds->out));
  if (!(std::abs(step.seconds - seconds) <= kConstant * seconds)) refuse(number, "has no constant acceleration");
  return block;
}

/// A lifted way, which may come as pieces of constant acceleration: straight ones are one.
void add_lifted(const ProgramStep& step, std::vector<EndFeedBlock>& blocks) {
  if (!blocks.empty() && !blocks.back().removes) {
    EndFeedBlock& last = blocks.back();
    const double direct = distance(last.start, step.finish), way = last.length() + step.length();
    if (way - direct <= kStraightWay * way) {
      last.finish = step.finish;
      return;
    }
  }
  blocks.push_back({step.start, step.finish, 0.0, false});
}

}  // namespace

std::vector<EndFeedBlock> blocks_of_motion(const Program& motion, const Progress& progress) {
  std::vector<EndFeedBlock> blocks;
  blocks.reserve(motion.steps.size());
  Poll poll(progress);
  double speed = 0.0;
  for (std::size_t i = 0; i < motion.steps.size(); ++i) {
    poll.step();
    const ProgramStep& step = motion.steps[i];
    const bool moves = step.removes && step.length() > 0.0;
    if (!moves && speed > 0.0) refuse(i, "is a halt or a lifted way that is reached at a speed");
    if (moves) {
      blocks.push_back(moving_block(step, i));
      speed = blocks.back().speed_out;
    } else if (step.removes && step.seconds > 0.0) {
      blocks.push_back({step.start, step.finish, step.seconds});
    } else if (!step.removes && step.length() > 0.0) {
      add_lifted(step, blocks);
    }
  }
  if (speed > 0.0) refuse(motion.steps.size() - 1, "is the last and ends at a speed");
  return blocks;
}

ProgramStep accelerated_step(Point start, Point finish, double speed_in, double speed_out) {
  const double length = distance(start, finish);
  const Point along = (1.0 / length) * (finish - start);
  return {start, finish, 2.0 * length / (speed_in + speed_out), true, EndSpeeds{speed_in * along, speed_out * along}};
}

void join_rounded_directions(Program& program) {
  for (std::size_t i = 0; i + 1 < program.steps.size(); ++i) {
    ProgramStep &before = program.steps[i], &after = program.steps[i + 1];
    if (!before.speeds || !after.speeds) continue;
    Point &out = before.speeds->out, &in = after.speeds->in;
    if (distance(out, in) > kRoundedDirection * std::max(length(out), length(in))) continue;
    out = in = midpoint(out, in);
  }
}

}  // namespace dwell
