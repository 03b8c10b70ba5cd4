#include "runs/plan/leave_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/anatomy/blemishes.h"
#include "core/base/time_limit.h"
#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/program_prediction.h"

namespace dwell {
namespace {

/// What dwell times leave of a part on the lattice, form terms included.
HeightMap left_on_lattice(const Part& part, const LaidPath& laid, const DwellPlan& plan, double max_feed) {
  const std::vector<double> seconds(plan.seconds.data(), plan.seconds.data() + plan.seconds.size());
  const Program program = program_of(laid.path, seconds, laid.motion, max_feed);
  return surface_after(part.map, simulate(program, part.map, plan.lattice.kernel, part.threads));
}

}  // namespace

DwellPlan leave_out_blemishes(const Part& part, const LaidPath& laid, DwellPlan plan, const DwellOptions& options,
                              const Progress& progress) {
  const std::vector<Blemish> blemishes =
      find_blemishes(plan.exact.surface, {.width = part.tif.fwhm, .of_fit = true}, part.threads, progress);
  LeftOut left_out;
  left_out.blemishes = static_cast<Index>(blemishes.size());
  for (const Blemish& b : blemishes) left_out.pixels.insert(left_out.pixels.end(), b.pixels.begin(), b.pixels.end());
  std::sort(left_out.pixels.begin(), left_out.pixels.end());
  left_out.fit_rms = left_out.rms_before = left_out.rms_before_without = plan.exact.statistics.rms_about_zero();
  if (blemishes.empty()) {
    plan.left_out = std::move(left_out);
    return plan;
  }
  left_out.rms_before_without =
      map_statistics(without_blemishes(plan.exact.surface, blemishes), part.form, part.threads).rms_about_zero();
  DwellPlan found;
  try {
    found = find_without(part, laid, left_out, plan.seconds, options, progress.of_part("blemishes left out"));
  } catch (const TimeLimitReached&) {
    plan.limits.push_back(
        fmt::format("the blemishes are not left out of the fit: `max solve` is {} s", options.max_seconds));
    return plan;
  }
  found.solver.seconds += plan.solver.seconds;
  return found;
}

DwellPlan find_without(const Part& part, const LaidPath& laid, LeftOut left_out, const Vector& start,
                       const DwellOptions& options, const Progress& progress) {
  const Part rest = without_pixels(part, left_out.pixels);
  DwellPlan found = find_dwell(rest, laid, options, progress, ExactCheck::Lattice, start);
  left_out.fit_rms = found.residual.rms_about_zero();
  const double max_feed = options.machine.feed_limits().max_feed;
  const HeightMap left = left_on_lattice(part, laid, found, max_feed);
  progress.check();
  found.residual = map_statistics(left, part.form, part.threads);
  found.exact = predict_dwell(part, laid, found.seconds, left, max_feed, ExactCheck::Lattice, progress);
  found.left_out = std::move(left_out);
  return found;
}

}  // namespace dwell
