#include "runs/figure/removal_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "core/map/map_arithmetic.h"
#include "core/map/map_warp.h"
#include "core/numerics/plane_transform.h"
#include "runs/figure/tool_removal.h"
#include "runs/plan/moved_program.h"
#include "solvers/fits/spike_removal.h"

namespace dwell {
namespace {

/// a - b without form terms, at the pixels of both.
HeightMap figure_of_difference(const HeightMap& a, const HeightMap& b, const Part& part) {
  return without_form(difference(a, b), part.form, part.threads);
}

double rms_of(const HeightMap& figure, const Part& part) {
  return map_statistics(figure, part.form, part.threads).rms_about_zero();
}

/// How far what was removed is looked for: by steps from which a fit finds its way, but not more than 20 each way.
OrientationReach reach_of(const Part& part) {
  const double longer = std::max(part.map.grid.width(), part.map.grid.height());
  constexpr double kMostSteps = 20.0;
  const double step = std::max(part.tif.fwhm / 3.0, 0.1 * longer / kMostSteps);
  return {std::max(2.0 * part.tif.fwhm, 0.1 * longer), step};
}

/// The shift and turn of a fit that started from a motion moved by `start`, as those of the motion as it was meant.
void add_start(RemovalRegistration& found, Point start) {
  const PlaneTransform all = composed(found.transform, similarity({}, start, 0.0, 1.0));
  const Point middle = all(found.about) - found.about;
  found.x.value = middle.x, found.y.value = middle.y;
  found.transform = all;
}

/// How much each cause changes what is removed.
void split_causes(const Part& part, const ToolRemoval& removal, const Program& motion, RemovalComparison& result) {
  const RemovalRegistration& found = result.registration;
  const HeightMap meant = removal.of(motion);
  const HeightMap by_tool = removal.of(motion, found.rate.value, found.width.value);
  const HeightMap by_all = removal.of(moved_program(motion, found.transform), found.rate.value, found.width.value);
  result.split.tool = rms_of(figure_of_difference(by_tool, meant, part), part);
  result.split.position = rms_of(figure_of_difference(by_all, by_tool, part), part);
  result.unexplained = figure_of_difference(result.measured, by_all, part);
  result.split.unexplained = rms_of(result.unexplained, part);
}

/// What was removed at the pixels of both maps. Throws InputError where these are too few.
HeightMap covered_removal(const Part& part, RemovalComparison& result) {
  const HeightMap& before = part.map;
  HeightMap removed = before;
  Index common = 0;
  for (std::size_t i = 0; i < removed.values.size(); ++i) {
    removed.values[i] -= result.after.values[i];
    common += std::isfinite(removed.values[i]) ? 1 : 0;
  }
  const Index all = before.valid_pixels();
  result.covered = static_cast<double>(common) / static_cast<double>(all);
  if (!(result.covered >= kLeastCover)) {
    throw InputError(fmt::format(
        "the map after the run has {} of the {} pixels of the part before it ({:.3g} %); required {:g} %: does "
        "it lie where that did (--map-origin, --step fiducials:...), and is its pitch right?",
        common, all, 100.0 * result.covered, 100.0 * kLeastCover));
  }
  return removed;
}

}  // namespace

RemovalComparison compare_removal(const Part& part, const MeasuredRun& run, const Progress& progress) {
  RemovalComparison result;
  const bool same_grid = grid_difference(part.map.grid, run.after.grid).empty();
  // Between its pixels a spline rings around dust: what stands alone is left out before.
  result.after = same_grid ? run.after
                           : warp_map(without_spikes(run.after, part.threads, progress).first, {}, part.map.grid,
                                      part.threads, progress);
  const HeightMap removed = covered_removal(part, result);
  result.measured = without_form(removed, part.form, part.threads);
  result.left = map_statistics(result.after, part.form, part.threads);
  const Program& motion = run.recorded ? *run.recorded : run.motion;
  const ToolRemoval removal(part, motion, progress.of_part("lattice"));
  const HeightMap simulated = removal.of(run.motion);
  result.predicted = without_form(simulated, part.form, part.threads);
  if (run.recorded) {
    progress.step("removal of the recorded motion");
    result.split.motion = rms_of(figure_of_difference(removal.of(motion), simulated, part), part);
  }
  const OrientationReach reach = reach_of(part);
  PredictedRemoval predicted = removal.predict(motion, kRegisteredWidths, reach.shift + part.tif.fwhm, progress);
  result.orientation =
      check_orientation(part.map, run.after, removed, predicted.removals[1], part.form, reach, part.threads, progress);
  if (!result.orientation.fault.empty() && !run.orientation_is_known) return result;
  const Point start = result.orientation.shift;
  const bool starts_elsewhere = start.x != 0.0 || start.y != 0.0;
  const Program begun = starts_elsewhere ? moved_program(motion, similarity({}, start, 0.0, 1.0)) : motion;
  if (starts_elsewhere) predicted = removal.predict(begun, kRegisteredWidths, reach.shift, progress);
  RemovalRegistrationOptions options;
  options.correlated_mm = part.tif.fwhm;
  options.level = part.form;
  options.scale = true;
  result.registration = register_removal(predicted, result.measured, options, part.threads, progress);
  if (starts_elsewhere) add_start(result.registration, start);
  progress.step("causes");
  split_causes(part, removal, motion, result);
  return result;
}

}  // namespace dwell
