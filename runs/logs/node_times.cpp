#include "runs/logs/node_times.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr double kWide = 4.0;     // how much farther out the other sample lies by which a stop is told
constexpr double kFinest = 3e-6;  // within the rounding of files [mm]

}  // namespace

NodeTimes::NodeTimes(std::span<const double> seconds, std::span<const double> ways, std::span<const double> nodes,
                     PlaceNoise noise)
    : seconds_(seconds),
      ways_(ways),
      nodes_(nodes),
      same_place_(noise.same),
      still_(std::max(kFinest, 4.0 * noise.noise)) {}

NodeTime NodeTimes::next(bool corner) {
  const double at = nodes_[k_], near = near_of(k_);
  while (coming_ < ways_.size() && ways_[coming_] < at - kWide * near) ++coming_;
  while (inside_ < ways_.size() && ways_[inside_] < at - near) ++inside_;
  while (rests_ < ways_.size() && ways_[rests_] < at - still_) ++rests_;
  while (passed_ < ways_.size() && ways_[passed_] < at) ++passed_;
  while (starts_ < ways_.size() && ways_[starts_] < at + still_) ++starts_;
  while (beyond_ < ways_.size() && ways_[beyond_] < at + near) ++beyond_;
  while (gone_ < ways_.size() && ways_[gone_] < at + kWide * near) ++gone_;
  NodeTime node;
  node.arrives = arrives(at, near);
  node.leaves = leaves(at, near);
  if (node.arrives > node.leaves) node.arrives = node.leaves = 0.5 * (node.arrives + node.leaves);
  node.passes = corner ? 0.5 * (node.arrives + node.leaves) : crossing(passed_, at);
  ++k_;
  return node;
}

/// What counts as at the node: kWide times as much is less than the steps on both sides.
double NodeTimes::near_of(std::size_t k) const {
  double near = same_place_;
  if (k > 0 && nodes_[k] > nodes_[k - 1]) near = std::min(near, (nodes_[k] - nodes_[k - 1]) / (4.0 * kWide));
  if (k + 1 < nodes_.size() && nodes_[k + 1] > nodes_[k])
    near = std::min(near, (nodes_[k + 1] - nodes_[k]) / (4.0 * kWide));
  return near;
}

double NodeTimes::seconds(std::size_t i) const { return seconds_[std::min(i, ways_.size() - 1)]; }

/// Between samples i - 1 and i.
double NodeTimes::crossing(std::size_t i, double way) const {
  if (i == 0 || i >= ways_.size()) return seconds(i);
  const double share = (way - ways_[i - 1]) / (ways_[i] - ways_[i - 1]);
  return seconds(i - 1) + std::clamp(share, 0.0, 1.0) * (seconds(i) - seconds(i - 1));
}

/// A machine comes to rest at constant acceleration: the root of the way that is left falls evenly. The last sample
/// outside, and the last that is kWide times as far, say when it is none.
double NodeTimes::arrives(double at, double near) const {
  std::size_t k = k_;
  while (k > 0 && nodes_[k] == at) --k;
  const double previous = nodes_[k];
  if (inside_ < 2 || coming_ < 1) return crossing(inside_, at - near);
  const std::size_t i1 = inside_ - 1, i0 = std::min(coming_ - 1, i1 - 1);
  if (ways_[i0] < previous) return crossing(inside_, at - near);
  const double d0 = std::sqrt(at - ways_[i0]), d1 = std::sqrt(at - ways_[i1]);
  if (!(d0 > d1)) return crossing(inside_, at - near);
  const double t1 = seconds(i1), t = t1 + d1 / (d0 - d1) * (t1 - seconds(i0));
  // Where the places are exact, the first sample at rest says that it has come.
  return std::min(t, std::max(t1, seconds(10.0 * still_ < near ? rests_ : beyond_)));
}

/// The same in reverse.
double NodeTimes::leaves(double at, double near) const {
  std::size_t k = k_;
  while (k + 1 < nodes_.size() && nodes_[k] == at) ++k;
  const double following = nodes_[k];
  const std::size_t i0 = beyond_, i1 = std::max(gone_, beyond_ + 1);
  if (i1 >= ways_.size() || ways_[i1] > following) return crossing(beyond_, at + near);
  const double e0 = std::sqrt(ways_[i0] - at), e1 = std::sqrt(ways_[i1] - at);
  if (!(e1 > e0)) return crossing(beyond_, at + near);
  const double t0 = seconds(i0), t = t0 - e0 / (e1 - e0) * (seconds(i1) - t0);
  const std::size_t rest = 10.0 * still_ < near ? starts_ : inside_;
  return std::max(t, std::min(t0, rest > 0 ? seconds(rest - 1) : seconds(0)));
}

}  // namespace dwell
