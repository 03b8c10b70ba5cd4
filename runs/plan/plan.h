#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/form/form.h"
#include "core/form/map_statistics.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_kernel.h"
#include "paths/feed/feed.h"
#include "paths/metrics/path_metrics.h"
#include "runs/job/input_files.h"
#include "runs/job/job_options.h"
#include "runs/plan/plan_search.h"
#include "runs/programs/feed_table.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Everything a plan is, before it is written: map + removal function -> path -> dwell -> feed.
struct Plan {
  JobOptions options;
  std::vector<InputFile> inputs;
  int threads = 1;

  HeightMap map;         // within the aperture, as measured [nm]
  Index map_pixels = 0;  // valid pixels of the whole file
  FormTerms terms;
  HeightMap figure;      // the map, form terms removed [nm]
  MapStatistics before;  // of it
  RemovalFunction tif;
  RemovalKernel kernel;

  Motion motion = Motion::Moving;
  ToolPath path;  // coordinates rounded to what the feed table holds
  std::vector<Stroke> strokes;
  PathMetrics metrics;

  Weights weights;                   // given, or found by
  std::optional<PlanSearch> search;  // nothing = both given
  Vector dwell;                      // [s], path order
  double step_rms = 0.0;             // of the dwell, |D t| / sqrt(number of links) [s]
  SolverSummary solver;
  Certificate certificate;
  MapStatistics residual;  // as the solver predicts, form terms removed

  FeedTable table;
  FeedSchedule feed;

  /// Limits that were reached, one sentence each; not empty = exit code 3.
  std::vector<std::string> limits;
};

/// Plans a job. Throws InputError for anything the user gave that cannot be used, Interrupted if the progress say stop.
/// Cost: the solver's operator applications dominate (docs/math.md).
Plan make_plan(const JobOptions& options, const Progress& progress);

/// The first part of make_plan: inputs read, path laid, no dwell yet.
Plan prepare_plan(const JobOptions& options, const Progress& progress);

/// The parts of both, for who plans several paths on one map: inputs read (options.path is not looked at); the path of
/// plan.options laid; dwell and feed found.
Plan read_inputs(const JobOptions& options, const Progress& progress);
void lay_path(Plan& plan, const Progress& progress);
void find_dwell(Plan& plan, const Progress& progress);

/// The limits on dwell and speed that the options set.
FeedLimits feed_limits(const JobOptions& options);

}  // namespace dwell
