#include "runs/figure/run_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/grid_limit.h"
#include "core/form/map_statistics.h"
#include "core/map/map_arithmetic.h"
#include "runs/figure/tool_removal.h"
#include "runs/plan/moved_program.h"

namespace dwell {
namespace {

constexpr double kDegreesPerMrad = 180.0 / std::numbers::pi / 1000.0;

const LessonDecision& decision_of(const ToolLesson& lesson, LessonSubject subject) {
  return lesson.decisions.at(static_cast<std::size_t>(subject));
}

/// The error of a figure, and what was found of it and not taken over.
double still_off(const LessonDecision& decision, double none) {
  const double rest = decision.applied ? decision.found.value - decision.used : decision.found.value - none;
  return std::hypot(decision.found.error, rest);
}

/// Half the difference of what two motions or tools remove, times `share`: the change by one standard deviation.
HeightMap half_difference(const HeightMap& a, const HeightMap& b, double share, const Part& part) {
  HeightMap change = difference(a, b);
  for (double& value : change.values) value *= 0.5 * share;
  return without_form(change, part.form, part.threads);
}

/// What a small movement of the machine changes, by the difference of two of this size.
HeightMap by_movement(const Part& part, const ToolRemoval& removal, const Program& motion, Point shift, double degrees,
                      double share) {
  const Point middle = middle_of(part.map.grid);
  const auto moved = [&](double sign) {
    const PlaneTransform move = similarity(middle, sign * shift, sign * degrees, 1.0);
    return removal.of(moved_program(motion, move));
  };
  return half_difference(moved(1.0), moved(-1.0), share, part);
}

}  // namespace

RunUncertainty uncertainty_after(const std::vector<ToolLesson>& lessons) {
  RunUncertainty unsure;
  if (lessons.empty()) return unsure;
  const ToolLesson& last = lessons.back();
  unsure.rate = still_off(decision_of(last, LessonSubject::Rate), 1.0);
  double squares = 0.0;
  for (std::size_t run = 1; run < lessons.size(); ++run)
    squares += std::pow(decision_of(lessons[run], LessonSubject::Rate).found.value - 1.0, 2);
  if (lessons.size() > 1)
    unsure.rate = std::max(unsure.rate, std::sqrt(squares / static_cast<double>(lessons.size() - 1)));
  unsure.width = still_off(decision_of(last, LessonSubject::Width), 1.0);
  unsure.shift = still_off(decision_of(last, LessonSubject::Shift), 0.0) / std::numbers::sqrt2;
  unsure.rotation = still_off(decision_of(last, LessonSubject::Rotation), 0.0);
  return unsure;
}

std::vector<UncertainSurface> uncertain_surfaces(const Part& part, const ToolRemoval& removal, const Program& motion,
                                                 const RunUncertainty& unsure, const Progress& progress) {
  std::vector<UncertainSurface> surfaces;
  progress.check();
  if (unsure.rate > 0.0) {
    HeightMap change = removal.of(motion);
    for (double& value : change.values) value *= unsure.rate;
    surfaces.push_back({"rate", without_form(change, part.form, part.threads)});
  }
  progress.check();
  if (unsure.width > 0.0) {
    const double step = std::clamp(unsure.width, 0.01, 0.2);
    surfaces.push_back({"width", half_difference(removal.of(motion, 1.0, 1.0 + step),
                                                 removal.of(motion, 1.0, 1.0 - step), unsure.width / step, part)});
  }
  progress.check();
  if (unsure.shift > 0.0) {
    const double step = 0.02 * part.tif.fwhm;
    surfaces.push_back({"shift in x", by_movement(part, removal, motion, {step, 0.0}, 0.0, unsure.shift / step)});
    surfaces.push_back({"shift in y", by_movement(part, removal, motion, {0.0, step}, 0.0, unsure.shift / step)});
  }
  progress.check();
  if (unsure.rotation > 0.0) {
    const double longer = std::max(part.map.grid.width(), part.map.grid.height());
    const double step = 0.04 * part.tif.fwhm / longer * 1000.0;  // moves the rim by as much as the shifts above [mrad]
    surfaces.push_back(
        {"rotation", by_movement(part, removal, motion, {}, kDegreesPerMrad * step, unsure.rotation / step)});
  }
  return surfaces;
}

}  // namespace dwell
