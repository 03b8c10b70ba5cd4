#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  double length() const { return high - low; }
};

/// Equidistant positions symmetric about the middle of an interval, as many as fit.
struct EvenPositions {
  double middle = 0.0;
  double step = 1.0;
  double count = 1.0;  // integral; a double so that an absurd one can be compared and reported

  /// As many as fit into the range widened by `overrun` on both sides.
  EvenPositions(const Interval& range, double overrun, double tick);
  double at(Index i) const { return middle + step * (static_cast<double>(i) - 0.5 * (count - 1.0)); }
  Index nearest(double v) const;
};

/// The positions of parallel lines across their direction [mm], ascending.
class LinePositions {
 public:
  explicit LinePositions(const EvenPositions& regular);
  /// At least one, strictly ascending.
  explicit LinePositions(std::vector<double> ascending) : positions_(std::move(ascending)) {}

  Index count() const { return static_cast<Index>(positions_.size()); }
  double at(Index line) const { return positions_[static_cast<std::size_t>(line)]; }
  /// The line nearest to a position; of two equally near ones the upper.
  Index nearest(double v) const;

 private:
  std::optional<EvenPositions> regular_;
  std::vector<double> positions_;
};

/// The frame of a scan, and how far the valid pixel centres of a map reach in it.
struct ScanFrame {
  Point along;   // unit vector of the lines
  Point across;  // 90 degrees counter-clockwise from it
  Interval u;    // extent along [mm]
  Interval v;    // extent across [mm]
};

/// The options that all planners of straight lines share.
struct ScanOptions {
  double pitch = 0.0;      // distance between lines [mm]
  double step = 0.0;       // distance between dwell points of a line [mm]
  double angle_deg = 0.0;  // direction of the lines, counter-clockwise from +x
  double overrun = 0.0;    // how far lines go on beyond the valid pixels [mm]
};

/// Throws InputError "PLANNER: OPTION = VALUE; required ..." unless all are finite, pitch and step > 0, overrun >= 0.
void check_scan_options(const ScanOptions& options, const char* planner);

/// Throws InputError if the map has no finite pixel. The angle is exact for multiples of 90 degrees. Cost O(pixels).
ScanFrame scan_frame(const HeightMap& map, double angle_deg, const char* planner);

/// Throws InputError if `lines` lines of `points` dwell points each, both integral, are more than 50 million in all.
void check_scan_size(const ScanOptions& options, double lines, double points, const char* planner);

/// Straight parallel lines over the valid pixels of a map, with dwell points at common positions along them.
///
/// A point is wanted if it lies within `overrun` of a valid pixel centre, or if it is the point nearest to one: nearest
/// line, then nearest position. A line runs from its first to its last wanted point, across whatever lies between. So
/// every valid pixel between two lines is within half their distance of one of them.
class ScanLines {
 public:
  /// First and last wanted point of a line; first > last if it has none.
  struct Run {
    Index first = std::numeric_limits<Index>::max();
    Index last = -1;

    void include(Index i) {
      first = std::min(first, i);
      last = std::max(last, i);
    }
    bool empty() const { return last < first; }
  };

  /// Cost O(pixels + points that are not wanted), where bounds on distances skip many of the latter.
  ScanLines(const HeightMap& map, const ScanFrame& frame, const EvenPositions& steps, LinePositions lines,
            double overrun, const Progress& progress = {});

  Index count() const { return lines_.count(); }
  const Run& run(Index line) const { return runs_[static_cast<std::size_t>(line)]; }
  Point at(Index line, Index step) const { return place(steps_.at(step), lines_.at(line)); }
  /// The point at u along and v across [mm].
  Point place(double u, double v) const { return u * along_ + v * across_; }
  double position(Index line) const { return lines_.at(line); }
  const EvenPositions& steps() const { return steps_; }
  /// Dwell points of all lines.
  std::size_t points() const;

 private:
  void include_nearest(const HeightMap& map, const Progress& progress);
  void include_within(const HeightMap& map, double overrun, const Progress& progress);

  Point along_, across_;
  EvenPositions steps_;
  LinePositions lines_;
  std::vector<Run> runs_;
};

}  // namespace dwell
