#include "runs/plan/learnt_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/form/map_statistics.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "paths/feed/late_motion.h"

namespace dwell {
namespace {

constexpr double kLaterShare = 0.5;  // of what a second log and those after it say: it is partly noise
constexpr double kMostEarly = 0.9;   // of a stroke's time, so that some is left

/// Of the strokes that the log tells of whole, what they took beyond what was expected; 0 of the others.
Eigen::VectorXd surprise(const std::vector<Index>& stroke, const LoggedMotion& run, const Eigen::VectorXd& expected,
                         LearntFromRun& lesson) {
  const Eigen::VectorXd took = sum_of_strokes(stroke, run.seconds, expected.size());
  Eigen::VectorXd surprise = Eigen::VectorXd::Zero(expected.size());
  for (Index j = 0; j < expected.size(); ++j) {
    if (!std::isfinite(took[j])) continue;
    surprise[j] = took[j] - expected[j];
    lesson.recorded_seconds += took[j];
    lesson.expected_seconds += expected[j];
  }
  return surprise;
}

HeightMap difference(HeightMap a, const HeightMap& b) {
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
  return a;
}

}  // namespace

LearntFromRun learn_motion(const Part& part, const StrokeMoves& moves, const Machine& machine, const LoggedMotion& run,
                           const std::optional<Eigen::VectorXd>& before, int logs_before, const Progress& progress) {
  LearntFromRun lesson;
  const std::vector<Index> stroke = strokes_of_steps(run.program, moves);
  const Execution execution = execute(run.program, machine, progress);
  const Eigen::VectorXd modelled = sum_of_strokes(stroke, execution.seconds, moves.strokes);
  const Eigen::VectorXd known = before ? *before : Eigen::VectorXd::Zero(moves.strokes);
  Eigen::VectorXd& late = lesson.learnt.late;
  late = known + (before ? kLaterShare : 1.0) * surprise(stroke, run, modelled + known, lesson);
  late = late.cwiseMax(-kMostEarly * modelled);
  lesson.learnt.logs = logs_before + 1;
  progress.check();
  const Program expected = late_motion(execution, late_of_steps(stroke, execution.seconds, late));
  const HeightMap removed = simulate(run.recorded, part.map, part.kernel, part.threads);
  progress.check();
  lesson.learnt.removal = difference(removed, simulate(expected, part.map, part.kernel, part.threads));
  lesson.recorded_rms = map_statistics(surface_after(part.map, removed), part.form, part.threads).rms_about_zero();
  lesson.removal_rms = map_statistics(lesson.learnt.removal, part.form, part.threads).rms_about_zero();
  lesson.late_mean = late.mean();
  lesson.late_rms = std::sqrt(late.squaredNorm() / static_cast<double>(late.size()));
  return lesson;
}

Program learnt_execution(const Program& program, const Machine& machine, const LearntMotion* learnt,
                         const StrokeMoves& moves, const Progress& progress) {
  Execution execution = execute(program, machine, progress);
  if (learnt == nullptr) return std::move(execution.motion);
  const std::vector<Index> stroke = strokes_of_steps(program, moves);
  return late_motion(execution, late_of_steps(stroke, execution.seconds, learnt->late));
}

Part with_learnt_removal(Part part, const HeightMap& removal) {
  part.map = difference(std::move(part.map), removal);
  return part;
}

}  // namespace dwell
