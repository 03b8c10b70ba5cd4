#pragma once

#include <string>
#include <vector>

#include "core/base/point.h"

namespace dwell {

/// One step of a machine program as the machine runs it: a straight move at constant speed (start != finish) or a halt
/// (start == finish). It takes `seconds`. `removes` is false for lifted moves.
struct ProgramStep {
  Point start;
  Point finish;
  double seconds = 0.0;
  bool removes = true;

  double length() const { return distance(start, finish); }
};

/// A machine program as read back from disk. Steps that remove nothing and whose duration the program does not say
/// (rapids) have seconds = 0.
struct Program {
  std::string file;
  std::vector<ProgramStep> steps;
  /// What the file left open and how it was read, a sentence each.
  std::vector<std::string> notes{};

  double total_seconds() const;    // all steps [s]
  double removing_length() const;  // [mm]
};

/// Whether two programs remove with the same steps, apart from the rounding in their files: they have equally many, and
/// for each the ends agree within 1e-6 mm and the durations within 1e-6 of themselves plus the time for 4e-6 mm at
/// `max_feed` [mm/s]. A NaN never agrees. What two such programs remove differs by no more than their durations do: for
/// a step of 0.4 mm at the maximum feed, by 1.1e-5 of it. Cost O(steps).
bool same_removing_steps(const Program& a, const Program& b, double max_feed);

}  // namespace dwell
