#pragma once

#include <optional>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "runs/figure/orientation_check.h"
#include "runs/plan/part.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {

/// What makes a measured removal other than the predicted one: RMS over the pixels of both, form terms removed, of what
/// each adds [nm].
struct RemovalSplit {
  std::optional<double> motion;  // the recorded motion in place of the simulated one; nothing without a log
  double tool = 0.0;             // its rate and width as found
  double position = 0.0;         // shift and rotation as found
  double unexplained = 0.0;      // the rest
};

/// A run as it was meant and as it was measured.
struct RemovalComparison {
  HeightMap after;        // the surface after the run, on the grid of the one before [nm]
  HeightMap measured;     // what was removed, without form terms [nm]
  HeightMap predicted;    // what was to be removed, likewise
  HeightMap unexplained;  // measured less what the fit makes of the predicted one, likewise
  MapStatistics left;     // of the surface after the run, form terms removed
  double covered = 1.0;   // share of the part's pixels that the map after the run has as well
  OrientationCheck orientation;
  RemovalRegistration registration;
  RemovalSplit split;
};

/// What a run removed.
struct MeasuredRun {
  HeightMap after;                    // the surface after it, on any grid [nm]
  Program motion;                     // as simulated: of the program as read back, as the machine executes it
  std::optional<Program> recorded{};  // as a log has it; then it is what the measured removal is compared with
  bool orientation_is_known = false;  // what the check of the orientation says is passed over
};

/// The share of the part's pixels that the map after a run must have.
inline constexpr double kLeastCover = 0.7;

/// Compares what a run removed with what it was meant to: difference of the maps before and after (the one after is
/// brought onto the grid of the one before by cubic B-spline where they differ), orientation, then register_removal
/// with the part's form terms as the level. `part` is the one before the run, with the tool as it was thought.
/// An error of orientation ends it: registration and split are then those of nothing. Throws InputError for a map after
/// the run that has less than kLeastCover of the part's pixels, and for a removal that says nothing about tool and
/// place, Interrupted. Cost: some eight simulations, 25 passes over the map, and the fit.
RemovalComparison compare_removal(const Part& part, const MeasuredRun& run, const Progress& progress = {});

}  // namespace dwell
