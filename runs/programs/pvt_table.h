#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// A place that the tool passes, with when and how fast.
struct PvtRow {
  double seconds = 0.0;  // from the beginning of the program
  Point place;           // [mm]
  Point speed;           // [mm/s]
  bool lifted = true;    // the way here is made with the tool lifted; of the first row it says nothing
  bool untold = false;   // how the tool runs on that way is not told, only how long; it rests at both ends
};

/// The steps of a controller's clock and places, of which the times and places of its tables are multiples; 0: as files
/// hold them.
struct PvtSteps {
  double seconds = 0.0;
  double millimetres = 0.0;
};

/// A program as positions, velocities and times: between two rows the tool runs along the cubic of time through both
/// (core/motion/cubic_move.h). The numbers are what every file of it holds: times on PMAC's grid of 1/4096 ms, or on
/// that of the controller's clock, to 1e-9 s; places to 1e-6 mm, or multiples of the controller's step; velocities to
/// 1e-6 mm/s. Each is rounded by itself, so that errors do not add up.
struct PvtTable {
  std::vector<PvtRow> rows;
  PvtSteps steps{};

  double seconds() const { return rows.empty() ? 0.0 : rows.back().seconds; }
};

/// What the columns of files of these tables are in.
inline constexpr std::string_view kPvtUnits = "t s, x and y mm, vx and vy mm/s";

/// The table of a motion whose every step takes time. A time that is rounded to the grid takes its place along, so that
/// the velocities still fit; with the steps of a controller's clock, place and velocity are those of the motion at that
/// time, and what happens between two steps of it is left out. Throws InputError naming the step where the velocity
/// jumps (by more than 0.2 %, which is what a direction that is rounded explains), or that takes no time.
PvtTable pvt_table_of(const Program& motion, const Progress& progress = {}, const PvtSteps& steps = {});

/// The steps of a machine's controller.
PvtSteps pvt_steps_of(const Machine& machine);

/// The steps between the rows, each with its velocities; without, where the tool rests at one place.
Program program_of(const PvtTable& table, const std::string& file);

/// The table with rows between, on the same cubics, so that no step takes longer than `most` [s].
PvtTable with_steps_of_at_most(double most, const PvtTable& table);

}  // namespace dwell
