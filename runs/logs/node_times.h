#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dwell {

/// When the tool was at the beginning of a step [s, by the log's clock].
struct NodeTime {
  double arrives = 0.0, leaves = 0.0;  // within the noise of the places
  double passes = 0.0;                 // at corners the middle of the two
};

/// How well the places of a log are known [mm].
struct PlaceNoise {
  double same = 1e-3;  // what counts as the same place along the path
  double noise = 0.0;  // standard deviation
};

/// The times at which the tool comes to the nodes of a path and leaves them, from samples of the way along it.
class NodeTimes {
 public:
  /// `ways` [mm] do not decrease and are of the samples; `nodes` [mm] neither. All outlive this.
  NodeTimes(std::span<const double> seconds, std::span<const double> ways, std::span<const double> nodes,
            PlaceNoise noise);

  /// Of every node in turn. Cost: O(samples + nodes) over all.
  NodeTime next(bool corner);

 private:
  double near_of(std::size_t k) const;
  double seconds(std::size_t i) const;
  double crossing(std::size_t i, double way) const;
  double arrives(double at, double near) const;
  double leaves(double at, double near) const;

  std::span<const double> seconds_, ways_, nodes_;
  double same_place_, still_;
  /// The node, and the first samples behind places about it, from far before to far behind.
  std::size_t k_ = 0, coming_ = 0, inside_ = 0, rests_ = 0, passed_ = 0, starts_ = 0, beyond_ = 0, gone_ = 0;
};

}  // namespace dwell
