#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/logs/fit_figures.h"
#include "runs/logs/logged_runs.h"

namespace dwell {

/// Values of some figures over a machine, fitted to the times of runs.
struct RunFit {
  LoggedMachine machine;
  std::vector<FitFigure> figures;
  std::vector<double> errors;  // standard errors of their values, NaN where the runs do not determine them
  double square_sum = 0.0;     // of logged less modelled times [s^2]

  double error_of(FitFigure figure) const;  // NaN if it was not fitted
  bool has(FitFigure figure) const;
};

/// The times that a machine takes for the runs of a program, and fits to the logged ones.
class RunModel {
 public:
  RunModel(const Program& program, std::vector<LoggedRun> runs, const Progress& progress);

  const std::vector<LoggedRun>& runs() const { return runs_; }
  void keep(std::vector<LoggedRun> runs) { runs_ = std::move(runs); }

  /// Logged less modelled, of every run [s].
  std::vector<double> differences(const LoggedMachine& machine) const;
  /// Their sum of squares [s^2].
  double square_sum(const LoggedMachine& machine) const;
  /// Fits the figures from the values that `start` has of them, which must be finite.
  RunFit fit(const LoggedMachine& start, const std::vector<FitFigure>& figures) const;
  /// The same with accelerations and junction deviation tried over all magnitudes first, the delay following.
  RunFit fit_from_scratch(LoggedMachine start, const std::vector<FitFigure>& figures) const;
  /// Schwarz's criterion of a fit for normal noise.
  double criterion(const RunFit& fit) const;

 private:
  const Program& program_;
  std::vector<LoggedRun> runs_;
  const Progress& progress_;
};

}  // namespace dwell
