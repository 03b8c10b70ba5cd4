#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"
#include "runs/figure/next_run.h"
#include "runs/figure/removal_comparison.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/run_folder.h"
#include "runs/figure/tool_lesson.h"
#include "runs/reports/recorded_run.h"
#include "runs/reports/surface_sheet.h"

namespace dwell {

/// A measurement after a run.
struct Measurement {
  JobOptions map;                 // its file and how that is read; the other options do not count
  std::string steps_of_this_map;  // map steps besides the run's own: not remembered
  std::optional<LogSource> log;   // of the controller, of the run
  LessonPolicy policy;
  std::optional<int> plan_step;       // whose program was run; nothing: the last that was planned
  int threads = 0;                    // 0: one for every processor
  bool orientation_is_known = false;  // an error of orientation that is found is passed over
};

/// What a measurement says, and what is made of it.
struct MeasuredStep {
  int iteration = 1;
  RemovalComparison comparison;
  ToolLesson lesson;
  MapStatistics before, predicted, after;  // form terms removed; predicted as the plan stated it
  double seconds = 0.0;                    // of the run, as planned
  SurfaceSheet surface;                    // before and after
  JobOptions next;                         // options of the next plan
  NextRun next_run;
  std::vector<std::string> warnings;  // what whoever measured should look at, a sentence each
  /// Not empty: an error of orientation, and nothing was added to the run.
  std::string fault;
  std::string folder;  // of the step, as seen from here; empty with a fault

  /// RMS before over RMS after.
  double convergence() const { return before.rms_about_zero() / after.rms_about_zero(); }
  /// The share of the improvement that was foreseen which came; nothing where none was foreseen.
  std::optional<double> efficiency() const;
};

/// Compares a measurement with the last plan and adds it to the run, unless it shows an error of orientation. The
/// caller holds the run's lock. Throws InputError where no plan waits for a measurement, where a step that it is
/// compared with is not as it was written, and as load_map, compare_removal and look_at_next_run; the run is then as
/// before.
MeasuredStep add_measurement(RunFolder& run, const FigureState& state, const Measurement& measurement,
                             const Progress& progress = {});

}  // namespace dwell
