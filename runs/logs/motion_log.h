#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/point.h"

namespace dwell {

/// Where the tool was over time, as a controller recorded it. Times increase from sample to sample.
struct MotionLog {
  std::string file;
  std::vector<double> seconds;
  std::vector<Point> places;      // [mm], in the part's frame
  double period = 0.0;            // of the sampling: the median time from sample to sample [s]
  std::vector<std::size_t> gaps;  // samples after which others are missing
  /// What the file left open and how it was read, and what was wrong with its clock, a sentence each.
  std::vector<std::string> notes;

  std::size_t size() const { return seconds.size(); }
};

}  // namespace dwell
