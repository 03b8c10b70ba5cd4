#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/logs/log_alignment.h"
#include "runs/machine/machine_file.h"

namespace dwell {

/// A figure of a machine that a log determines.
struct FittedFigure {
  std::string name;  // as people call it: "acceleration along the path"
  std::string key;   // for JSON: "path_acceleration"
  std::string unit;  // "mm/s^2"; empty: none
  double value = 0.0;
  double error = 0.0;      // standard error
  double explained = 0.0;  // share of the mean square by which the runs' times differ from the commanded ones, that
                           // goes when this figure joins those before it
  bool written = false;    // machine files have it
};

/// One that it does not, and why.
struct UndeterminedFigure {
  std::string name, why;
};

struct MachineFit {
  Machine machine;  // the one that the fit began with, with what was fitted in its place
  std::vector<FittedFigure> fitted;
  std::vector<UndeterminedFigure> undetermined;
  std::vector<std::string> notes;
  std::size_t runs = 0;      // from corner to corner, that were fitted
  std::size_t outliers = 0;  // left out because they differ by over six robust standard deviations of the others
  std::size_t gaps = 0, lifted = 0;                      // left out: LoggedRuns
  double commanded_rms = 0.0;                            // of the logged less the commanded times of the runs [s]
  double rms = 0.0;                                      // of the logged less the modelled ones [s]
  double logged = 0.0, modelled = 0.0, commanded = 0.0;  // sums over these runs [s]
};

inline constexpr std::size_t kLeastRuns = 8;

/// Fits a machine to the time that each run of a program took, from corner to corner: acceleration (along the path, or
/// of each axis where that explains the log better), delay at a corner where the machine stops, corner rule (unless
/// the program says its path mode), speed limit if it was reached, and, besides, the scale of the log's clock and a
/// delay a block, which machine files do not have. The model is step_times. A figure enters, and a rule
/// changes, only where Schwarz's criterion falls by more than 10. What the log does not determine stays as in `start`.
/// Throws InputError for fewer than kLeastRuns runs, for a program that says speeds at the ends of its steps, as
/// kinematic_path; Interrupted. Cost: a few hundred times step_times.
MachineFit fit_machine(const AlignedLog& aligned, const Program& program, const Machine& start,
                       const Progress& progress = {});

/// The machine file of a fit, with what was fitted, to what, and how well as comments.
std::string fitted_machine_text(const MachineFit& fit, const std::string& name, const std::string& log);

}  // namespace dwell
