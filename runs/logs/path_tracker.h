#pragma once

#include <cstddef>
#include <vector>

#include "core/base/point.h"
#include "core/motion/program.h"

namespace dwell {

/// Follows a place that runs along the straight steps of a program: forward only, each time to the nearest place within
/// reach of the last one. So a path that crosses itself, or comes back on its own track, is followed in its order.
/// Cost: O(1) a call, and O(steps) over all.
class PathTracker {
 public:
  /// Over steps [first, end) of the program. A place farther along the path is taken only if it is nearer to the tool
  /// by more than `margin` [mm], the noise of the places.
  PathTracker(const std::vector<ProgramStep>& steps, std::size_t first, std::size_t end, double margin);

  /// Moves on to the place on the path that is nearest to `tool`, at most `reach` [mm] farther along; stays where it is
  /// if that is farther off than `tolerance` [mm] from a step that removes: one stray place must not carry it ahead.
  void follow(Point tool, double reach, double tolerance);

  double way() const { return along_; }                   // from the beginning of the first step [mm]
  double off() const { return off_; }                     // distance of the last place from there [mm]
  std::size_t step() const { return step_; }              // of the program
  bool removes() const { return steps_[step_].removes; }  // of the step that it is in
  double total() const { return ways_.back(); }           // length of all steps [mm]
  /// From the beginning of the first step to that of step first + k [mm].
  double way_to(std::size_t k) const { return ways_[k]; }

 private:
  const std::vector<ProgramStep>& steps_;
  std::size_t first_, end_, step_;
  double margin_, along_ = 0.0, off_ = 0.0;
  std::vector<double> ways_;
};

}  // namespace dwell
