#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/spectra/psd.h"
#include "paths/metrics/path_ripple.h"
#include "paths/metrics/path_spacing.h"
#include "paths/metrics/ripple_spectrum.h"
#include "runs/base/json_blocks.h"
#include "runs/base/output_folder.h"
#include "runs/base/shard.h"
#include "runs/campaigns/sweep_sheet.h"
#include "runs/job/path_list.h"
#include "runs/job/planned_job.h"

namespace dwell {

/// The result of one path of a comparison.
struct ComparedPath {
  ListedPath listed;
  std::string failure;       // why there is no plan; empty if there is one, and only then is the rest filled
  bool out_of_time = false;  // that is why

  std::string kind;  // of the path, as its planner names it
  PathMetrics metrics;
  PathSpacing spacing;       // to the neighbouring track
  double coverage = 0.0;     // share of the valid pixels within a pitch of the path (PathComparison::pitch)
  double tree_length = 0.0;  // no path through the points is shorter than their minimum spanning tree [mm]
  std::vector<std::string> notes, limits;         // of the planner; of the plan (WrittenPlan::limits)
  double residual_rms = 0.0;                      // of the program as read back, simulated [nm]
  double residual_pv = 0.0;                       // [nm]
  std::optional<double> residual_pvr;             // [nm]
  std::optional<RippleSpectrum> residual_ripple;  // of the residual; none where the map shows nothing of the band
  /// The ripple at constant feed on a fine patch where the part is widest, whatever the map's pixels; its map is left
  /// empty. None where there is no room for the patch; `no_ripple` says why.
  std::optional<PathRipple> ripple;
  std::string no_ripple;
  PsdCurve spectrum;                        // of the residual, radial
  double dwell_total = 0.0;                 // [s]
  double dwell_min = 0.0, dwell_max = 0.0;  // of a point [s]
  double step_rms = 0.0;                    // [s]
  double lift_time = 0.0;                   // lifted moves and the way up to them, at maximum feed [s]
  double total_time = 0.0;                  // of the program, the way down after a lift included, and lift_time [s]
  SolverSummary solver;
  ProgramFigures program;  // as read back, with residual_rms and residual_pv

  /// RMS of the residual between the wavelengths 33 and 0.12 mm, as far as the map resolves them [nm].
  std::optional<double> mid_rms() const {
    return residual_ripple ? std::optional<double>(residual_ripple->rms) : std::nullopt;
  }
  /// A plan that was cut short is not what the path can do.
  bool whole() const { return failure.empty() && solver.converged(); }
  /// Whether it is whole, and no other whole path is as good in residual, mid_rms and total_time and better in one.
  bool on_front = false;
};

struct PathComparison {
  SweepSheet sheet;    // of the job, whose own path is not used
  std::string list;    // of the paths, as it was given
  double pitch = 0.0;  // of the paths that gave none [mm]
  bool pitch_given = false;
  PsdCurve before;                  // spectrum of the map, form terms removed
  std::vector<ComparedPath> paths;  // in the order of the list
  std::vector<std::string> limits;  // not empty = exit code 3
};

/// A quarter of the FWHM of a removal function, down to two digits [mm]: tracks that close leave next to no ripple.
double default_pitch(const RemovalFunction& tif);

/// Marks the paths that no other dominates in (residual_rms, mid_rms, total_time), all to be small; where the map does
/// not resolve the mid band, it does so for no path, and the other two decide. Paths that failed or whose solve did not
/// converge are neither on the front nor do they keep others off it. Cost O(n^2).
void mark_front(std::vector<ComparedPath>& paths);

/// Plans the paths of `list` that are a shard's for the job, each completely (path, dwell, program, simulation of the
/// program as read back) and into a folder of its own name within `folder`; of the others there is the name alone.
/// `pitch` [mm] is for the paths that give none; default_pitch if not given. A path that cannot be planned is reported
/// as such and the others go on. Throws Interrupted, or as load_job does for the inputs. Cost: that of the plans.
PathComparison plan_paths(const JobOptions& options, const std::string& list, std::optional<double> pitch,
                          const Shard& shard, const OutputFolder& folder, const Progress& progress);

/// What only all paths together show: marks the front and collects the limits. Throws InputError, or TimeLimitReached
/// where that was why, if none could be planned.
void conclude(PathComparison& comparison);

/// plan_paths of all and conclude.
PathComparison compare_paths(const JobOptions& options, const std::string& list, std::optional<double> pitch,
                             const OutputFolder& folder, const Progress& progress);

}  // namespace dwell
