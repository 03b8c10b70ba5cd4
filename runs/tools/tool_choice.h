#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "runs/tools/joint_problem.h"
#include "solvers/weights/time_worth.h"
#include "solvers/weights/weight_goal.h"

namespace dwell {

/// A set of tools that was tried.
struct TriedTools {
  std::vector<std::size_t> tools;  // by their numbers, ascending
  double price = 0.0;              // common, of a second [nm^2/s]
  double residual_rms = 0.0;       // as the lattices have it [nm]
  double seconds = 0.0;            // of dwell, of all of them
  double change_over = 0.0;        // of all of them [s]
  double cost = 0.0;               // by which sets are compared [nm^2]
  SolverStatus status = SolverStatus::NotRun;
  double gap = 0.0;  // Certificate::gap of its solve
};

/// Which of several tools pay.
struct ToolChoice {
  std::optional<TimePrice> worth;  // how the price was found, where it was
  std::vector<TriedTools> tried;   // in the order of the solves: all tools first
  std::size_t chosen = 0;          // number of the set in `tried`
  JointDwell dwell;                // of that set
  long applications = 0;           // of the full operators, in all solves
  double seconds = 0.0;            // of wall clock, of all solves

  const TriedTools& set() const { return tried[chosen]; }
};

/// A set of fewer tools is taken if its cost is above that of more by no more than this share: which is as well as the
/// costs are known.
inline constexpr double kSameCost = 1e-3;

/// Of a total that is asked for, the dwell and change-over of a set come to the first share at least, if any price
/// does, and to the second at most: the tools' own plans find the same dwell, but to the solver's tolerance.
inline constexpr double kUsedOfTotal = 0.98;
inline constexpr double kMostOfTotal = 0.995;

/// Finds out which tools pay: solves with all of them, then without each in turn, and goes on without the one whose
/// loss costs least as long as the cost does not rise. `goal` says the common price of a second [nm^2/s]: a number;
/// Auto, by the rules with all tools; or TotalAtMost, where each set has the least price at which its dwell and
/// change-over fit into so many seconds. Cost is JointDwell::cost, in which change-over counts; within a total, what it
/// is without time. `max_seconds` bounds each solve. Throws as JointProblem, and InputError if not even one tool fits
/// into the total. Cost: for K tools at most K (K + 1) / 2 sets; a solve each, and with a total about eight.
ToolChoice choose_tools(JointProblem& problem, const WeightGoal& goal, const TimeWorth& worth, double max_seconds,
                        const Progress& progress = {});

}  // namespace dwell
