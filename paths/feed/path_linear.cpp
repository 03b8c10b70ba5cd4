#include "paths/feed/path_linear.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dwell {
namespace {

constexpr double kEven = 1e-9;             // of a speed, a change that is none
constexpr double kOneBlock = 0.02;         // of a speed, a change that costs no more than 3e-5 of the time in one block
constexpr double kMostRatio = 1.35;        // of the speeds at the ends of a block
constexpr double kLastRatio = 1.15;        // which the last of a row has at least
constexpr double kOfAcceleration = 0.985;  // of the machine's, up to which speeds are raised to hold the time
constexpr int kMostFromRest = 3;           // blocks after the even one
constexpr double kWithin = 5e-7;           // of cubics beside the exact motion [mm]
constexpr int kBisections = 60;

double most(const EndFeedBlock& block) { return std::max(block.speed_in, block.speed_out); }

double acceleration_along(const EndFeedBlock& block, const Machine& machine) {
  return acceleration_limit(machine, block.finish - block.start);
}

/// The root of a function that falls from above 0 at `low` to below at `high`.
template <class Function>
double root_of_falling(double low, double high, const Function& value) {
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (value(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A place on a block by its share of the length, and the speed there.
struct Node {
  double share, speed;
};

void mirror(std::vector<Node>& nodes) {
  std::reverse(nodes.begin(), nodes.end());
  for (Node& node : nodes) node.share = 1.0 - node.share;
}

void add_between(const EndFeedBlock& block, const std::vector<Node>& nodes, bool first_even, bool last_even,
                 std::vector<EndFeedBlock>& result) {
  const auto place = [&](double share) {
    if (share >= 1.0) return block.finish;
    return block.start + share * (block.finish - block.start);
  };
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    EndFeedBlock part{place(nodes[k].share), place(nodes[k + 1].share)};
    part.speed_in = nodes[k].speed;
    part.speed_out = nodes[k + 1].speed;
    part.even = (first_even && k == 0) || (last_even && k + 2 == nodes.size());
    result.push_back(part);
  }
}

/// Nodes of constant acceleration between two speeds, the lower one first, so that the speed grows by no more than
/// kMostRatio from one to the next, as far as none is then nearer in time than `least_seconds`.
std::vector<Node> nodes_between(double low, double high, double length, double least_seconds) {
  const double gain = high * high - low * low, acceleration = gain / (2.0 * length);
  std::vector<Node> nodes{{0.0, low}};
  const auto add = [&](double speed) { nodes.push_back({(speed * speed - low * low) / gain, speed}); };
  const double change = high - low, seconds = change / acceleration;
  if (change > kOneBlock * low && seconds >= 2.0 * least_seconds) {
    for (double v = low;;) {
      v = std::max(kMostRatio * v, v + acceleration * least_seconds);
      if (v * kLastRatio >= high || v + acceleration * least_seconds > high) break;
      add(v);
    }
    if (nodes.size() == 1) add(0.5 * (low + high));
  }
  nodes.push_back({1.0, high});
  return nodes;
}

/// The largest acceleration of blocks between nodes.
double largest_acceleration(const std::vector<Node>& nodes, double length) {
  double largest = 0.0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double in = nodes[k].speed, out = nodes[k + 1].speed;
    largest =
        std::max(largest, std::max(in, out) * std::abs(out - in) / ((nodes[k + 1].share - nodes[k].share) * length));
  }
  return largest;
}

std::vector<Node> with_inner_speeds(std::vector<Node> nodes, double factor) {
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) nodes[k].speed *= factor;
  return nodes;
}

/// Between two speeds > 0.
void add_ramp(const EndFeedBlock& block, double acceleration, double least_seconds, std::vector<EndFeedBlock>& result) {
  const double low = std::min(block.speed_in, block.speed_out), length = block.length();
  const double seconds = 2.0 * length / (block.speed_in + block.speed_out);
  const bool grows = block.speed_out > block.speed_in;
  std::vector<Node> nodes{{0.0, block.speed_in}, {1.0, block.speed_out}};
  if (most(block) - low > kEven * low) nodes = nodes_between(low, most(block), length, least_seconds);
  if (nodes.size() > 2) {
    constexpr double kMostFactor = 1.25;
    const auto late = [&](double factor) {
      const std::vector<Node> now = with_inner_speeds(nodes, factor);
      double sum = -seconds;
      for (std::size_t k = 0; k + 1 < now.size(); ++k)
        sum += path_linear_seconds((now[k + 1].share - now[k].share) * length, now[k].speed, now[k + 1].speed);
      return sum;
    };
    double factor = root_of_falling(1.0, kMostFactor, late);
    const double limit = kOfAcceleration * acceleration;
    if (largest_acceleration(with_inner_speeds(nodes, factor), length) > limit) {
      factor = root_of_falling(1.0, factor, [&](double trial) {
        return limit - largest_acceleration(with_inner_speeds(nodes, trial), length);
      });
    }
    nodes = with_inner_speeds(std::move(nodes), factor);
  }
  if (!grows) mirror(nodes);
  add_between(block, nodes, false, false, result);
}

/// The share of the speed at the other end that an even block from rest has, with `parts` blocks after it, each of the
/// same ratio of speeds. With b that share and q the ratio, times in L / v: the even block takes b (1 + a' / a) where
/// constant acceleration takes 2 b; the others take ln q (q + 1) / (q - 1) (1 - b) for 2 (1 - b).
double even_share(double acceleration_share, int parts) {
  return root_of_falling(1e-6, 1.0 - 1e-6, [&](double b) {
    const double q = std::pow(b, -1.0 / parts);
    return (1.0 - b) * (std::log(q) * (q + 1.0) / (q - 1.0) - 2.0) - b * (1.0 - acceleration_share);
  });
}

/// From rest, or, mirrored, to it.
void add_rest_ramp(const EndFeedBlock& block, double acceleration, double least_seconds,
                   std::vector<EndFeedBlock>& result) {
  const double v = most(block), length = block.length();
  const double share = std::min(1.0, v * v / (2.0 * length) / acceleration);
  int parts = kMostFromRest;
  double b = even_share(share, parts);
  while (parts > 1 && b * length / v < least_seconds) b = even_share(share, --parts);
  std::vector<Node> nodes{{0.0, 0.0}};
  for (int k = 0; k <= parts; ++k) {
    const double part = k == parts ? 1.0 : b * std::pow(b, -static_cast<double>(k) / parts);
    nodes.push_back({part * part, part * v});
  }
  const bool leaves = block.speed_in == 0.0;
  if (!leaves) mirror(nodes);
  add_between(block, nodes, leaves, !leaves, result);
}

/// The exponential of time between two speeds.
void add_exponential(const EndFeedBlock& block, std::vector<ProgramStep>& steps) {
  const double v0 = block.speed_in, v1 = block.speed_out, length = block.length();
  const double change = std::abs(v1 - v0), ratio = std::log(v1 / v0);
  if (change <= kEven * most(block)) {
    steps.push_back(accelerated_step(block.start, block.finish, v0, v1));
    return;
  }
  // A cubic of the time h lies beside a motion whose acceleration changes by h^4 / 384 of its fourth derivative, which
  // is k^3 v with k = (v1 - v0) / L.
  const double parts = std::ceil(std::abs(ratio) * std::pow(most(block) * length / (384.0 * kWithin * change), 0.25));
  const double seconds = path_linear_seconds(length, v0, v1);
  const Point along = (1.0 / length) * (block.finish - block.start);
  Point from = block.start;
  double before = v0;
  for (double k = 1.0; k <= parts; ++k) {
    const double v = k < parts ? v0 * std::exp(ratio * k / parts) : v1;
    const Point to = k < parts ? block.start + (length * (v - v0) / (v1 - v0)) * along : block.finish;
    steps.push_back({from, to, seconds / parts, true, EndSpeeds{before * along, v * along}});
    from = to;
    before = v;
  }
}

void add_even(const EndFeedBlock& block, double acceleration, std::vector<ProgramStep>& steps) {
  const double v = most(block), length = block.length(), ramp = v * v / (2.0 * acceleration);
  const double up = block.speed_in == 0.0 ? ramp : 0.0, down = block.speed_out == 0.0 ? ramp : 0.0;
  const Point along = (1.0 / length) * (block.finish - block.start);
  Point from = block.start;
  const auto add = [&](double until, double in, double out) {
    const Point to = until < length ? block.start + until * along : block.finish;
    if (to != from) steps.push_back(accelerated_step(from, to, in, out));
    from = to;
  };
  if (up > 0.0) add(std::min(up, length - down), 0.0, v);
  if (length - up - down > kEven * length) add(length - down, v, v);
  if (down > 0.0) add(length, v, 0.0);
}

}  // namespace

double path_linear_seconds(double length, double speed_in, double speed_out) {
  const double change = speed_out - speed_in;
  // Where the speeds are near each other, the first terms of the series in x = change / sum: 2 L / sum (1 + x^2 / 3).
  const double x = change / (speed_in + speed_out);
  if (std::abs(x) < 1e-4) return 2.0 * length / (speed_in + speed_out) * (1.0 + x * x / 3.0);
  return length * std::log(speed_out / speed_in) / change;
}

std::vector<EndFeedBlock> blocks_over_path(const std::vector<EndFeedBlock>& blocks, const Machine& machine,
                                           double least_seconds) {
  std::vector<EndFeedBlock> result;
  result.reserve(3 * blocks.size());
  for (const EndFeedBlock& block : blocks) {
    if (!block.removes || block.halts()) {
      result.push_back(block);
    } else if (block.speed_in > 0.0 && block.speed_out > 0.0) {
      add_ramp(block, acceleration_along(block, machine), least_seconds, result);
    } else {
      add_rest_ramp(block, acceleration_along(block, machine), least_seconds, result);
    }
  }
  return result;
}

bool has_room(const EndFeedBlock& block, double acceleration) {
  const double v = most(block), ramp = v * v / (2.0 * acceleration);
  const double ramps = (block.speed_in == 0.0 ? ramp : 0.0) + (block.speed_out == 0.0 ? ramp : 0.0);
  return ramps <= block.length() * (1.0 + kEven);
}

std::vector<ProgramStep> steps_over_path(const EndFeedBlock& block, double acceleration) {
  std::vector<ProgramStep> steps;
  if (!block.removes || block.halts()) {
    steps.push_back({block.start, block.finish, block.seconds, block.removes});
  } else if (block.even) {
    add_even(block, acceleration, steps);
  } else {
    add_exponential(block, steps);
  }
  return steps;
}

Program motion_over_path(const std::vector<EndFeedBlock>& blocks, const Machine& machine) {
  Program program;
  for (const EndFeedBlock& block : blocks) {
    const double acceleration = block.removes && !block.halts() ? acceleration_along(block, machine) : 0.0;
    for (const ProgramStep& step : steps_over_path(block, acceleration)) program.steps.push_back(step);
  }
  return program;
}

}  // namespace dwell
