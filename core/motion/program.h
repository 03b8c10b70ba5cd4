#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/point.h"
#include "core/motion/program_frame.h"

namespace dwell {

/// Velocities at the ends of a step [mm/s].
struct EndSpeeds {
  Point in, out;

  bool operator==(const EndSpeeds&) const = default;
};

/// One step of a machine program as the machine runs it: a straight move at constant speed (start != finish) or a halt
/// (start == finish), or with `speeds` the cubic of time through its ends with these velocities (CubicMove). It takes
/// `seconds`. `removes` is false for lifted moves.
struct ProgramStep {
  Point start;
  Point finish;
  double seconds = 0.0;
  bool removes = true;
  std::optional<EndSpeeds> speeds{};

  double length() const { return distance(start, finish); }
};

/// How the machine runs the ends of moves, as a program asks for it (G61, G61.1, G64).
struct PathMode {
  enum class Kind {
    ExactPath,  // through the programmed points, slowing down as far as that needs (G61)
    ExactStop,  // with a stop at the end of every move (G61.1)
    Blended,    // rounded, so that the speed is kept (G64)
  };
  Kind kind = Kind::ExactPath;
  /// Of Blended: how far the tool may run beside the programmed path [mm] (P); nothing: as far as the machine likes.
  std::optional<double> tolerance_mm{};
  /// Of Blended: how far a row of short moves may lie beside the one that replaces them [mm] (Q).
  std::optional<double> merging_mm{};

  bool operator==(const PathMode&) const = default;
};

/// A path mode holds from one step on until the next change, or the end.
struct PathModeChange {
  std::size_t first_step = 0;  // index into the program's steps; may be their number, where no step follows
  PathMode mode;

  bool operator==(const PathModeChange&) const = default;
};

/// A machine program as read back from disk. Steps that remove nothing and whose duration the program does not say
/// (rapids) have seconds = 0.
struct Program {
  std::string file;
  std::vector<ProgramStep> steps;
  /// What the file left open and how it was read, a sentence each.
  std::vector<std::string> notes{};
  /// In the order of their steps, none for steps before the first change: there the machine's own setting holds. What a
  /// program removes is computed from its steps as written, whatever the mode.
  std::vector<PathModeChange> path_modes{};
  /// Of rapids before the last of the work, up and across, as far as the file says where they begin [mm].
  double rapid_length = 0.0;
  double fastest_feed = 0.0;  // of its feed moves, or what its header allows [mm/s]; 0 where neither is known
  /// In which the file has its places. The steps here are in the part's coordinates.
  ProgramFrame frame{};

  double total_seconds() const;  // all steps [s]; rapids count as none
  /// Of rapids, which no program says: at `feed` [mm/s], or else at the fastest feed.
  double rapid_seconds(std::optional<double> feed = {}) const;
  /// Of the run: all steps, and the rapids. The one definition of a run's time, for plans and simulations.
  double run_seconds(std::optional<double> feed = {}) const { return total_seconds() + rapid_seconds(feed); }
  double removing_length() const;  // [mm]
};

/// Whether two programs remove with the same steps, apart from the rounding in their files: they have equally many, and
/// for each the ends agree within 1e-6 mm and the durations within 1e-6 of themselves plus the time for 4e-6 mm at
/// `max_feed` [mm/s]. A NaN never agrees. What two such programs remove differs by no more than their durations do: for
/// a step of 0.4 mm at the maximum feed, by 1.1e-5 of it. Cost O(steps).
bool same_removing_steps(const Program& a, const Program& b, double max_feed);

}  // namespace dwell
