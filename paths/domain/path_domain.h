#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "paths/domain/distance_map.h"

namespace dwell {

/// A rectangle along the axes [mm].
struct Box {
  Point low, high;
};

/// Whether a point is in a domain, and how far around it that holds.
struct DomainView {
  bool inside = false;
  double holds_for = 0.0;  // every point nearer to it than this [mm] has the same `inside`
};

/// Where a path may go: within a distance of a valid (finite) pixel centre of a map. Points exactly that far away are
/// inside, whatever the rounding (to 1e-9 of the pixel pitch).
class PathDomain {
 public:
  /// reach [mm], finite and >= 0. `planner` and `option` begin the messages of InputError, thrown if the reach is out
  /// of range or the map has no finite pixel. Cost O(pixels).
  PathDomain(const HeightMap& map, double reach, const char* planner, const char* option = "overrun",
             const Progress& progress = {});

  /// Cost O(1), except for points at about the distance of the reach.
  bool contains(Point p) const { return distance_.within(p, padded_); }

  /// contains(p), and a distance around p within which the answer is the same, so that a planner need not ask at every
  /// step. Cost as contains.
  DomainView look(Point p) const;

  double reach() const { return reach_; }
  /// Of the valid pixel centres, not widened by the reach.
  const Box& box() const { return box_; }
  /// Middle of the box.
  Point middle() const { return midpoint(box_.low, box_.high); }

 private:
  static double checked(double reach, const char* planner, const char* option);

  double reach_;
  double padded_;
  Box box_;
  DistanceMap distance_;
};

}  // namespace dwell
