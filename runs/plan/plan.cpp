#include "runs/plan/plan.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/threads.h"
#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "core/map/aperture.h"
#include "core/motion/motion.h"
#include "paths/feed/plan_program.h"
#include "paths/path_catalogue.h"
#include "runs/plan/plan_problem.h"

namespace dwell {
namespace {

/// The path with coordinates as the feed table holds them (1e-6 mm), so that what is solved is what is exported.
ToolPath rounded(ToolPath path) {
  constexpr double kPerMm = 1e6;
  for (Point& p : path.points) p = {std::round(p.x * kPerMm) / kPerMm, std::round(p.y * kPerMm) / kPerMm};
  path.lifted[0] = 1;
  return path;
}

void solve_dwell(Plan& plan, const Progress& progress) {
  const JobOptions& o = plan.options;
  progress.report("solve: removal operator, target and form");
  PlanProblem problem(plan);
  progress.check();
  WeightedDwell found;
  if (plan.search) {
    found = search_plan(problem, o, progress, *plan.search);
  } else {
    found = problem.solve({o.smoothness.value, o.time_price_nm2_per_s.value}, {}, o.max_solve_s, "solve", progress);
  }
  plan.weights = found.weights;
  plan.dwell = std::move(found.dwell);
  plan.solver = std::move(found.solver);
  plan.step_rms = found.trade_off.step_rms;
  progress.report("solve: certificate");
  plan.certificate = certify(problem.with(plan.weights), plan.dwell);
  plan.residual = map_statistics(problem.left_by(plan.dwell), plan.terms, plan.threads);
}

void schedule_feed(Plan& plan) {
  const JobOptions& o = plan.options;
  plan.feed = feed_schedule(plan.strokes, plan.dwell, feed_limits(o));
  // Halts have no length; the machine moves between them at maximum feed.
  if (plan.motion == Motion::Stop) plan.feed.min_speed = plan.feed.max_speed = units::mm_per_s(o.max_feed_mm_per_min);
  plan.table = feed_table_of(plan.path, {plan.dwell.begin(), plan.dwell.end()}, plan.motion, o.max_feed_mm_per_min);
  if (!plan.solver.converged()) {
    const bool time = plan.solver.status == SolverStatus::TimeLimit;
    plan.limits.push_back(fmt::format("solver {}: {}: {}{}", o.solver, to_string(plan.solver.status),
                                      plan.solver.message,
                                      time ? fmt::format("; --max-solve is {} s", o.max_solve_s) : ""));
  }
  if (plan.search) plan.limits.insert(plan.limits.end(), plan.search->limits.begin(), plan.search->limits.end());
  if (plan.feed.segments_infeasible > 0) {
    plan.limits.push_back(fmt::format("{} of {} segments run faster than --max-feed {} mm/min allows",
                                      plan.feed.segments_infeasible, plan.path.size(), o.max_feed_mm_per_min));
  }
}

}  // namespace

FeedLimits feed_limits(const JobOptions& o) { return {o.min_dwell_s, units::mm_per_s(o.max_feed_mm_per_min)}; }

Plan read_inputs(const JobOptions& o, const Progress& progress) {
  Plan plan;
  plan.options = o;
  plan.threads = thread_count(o.threads);
  HeightMap whole = load_map(o, plan.inputs, progress);
  plan.map_pixels = whole.valid_pixels();
  plan.map = within(std::move(whole), parse_aperture(o.aperture));
  plan.terms = parse_form_terms(o.remove);
  plan.figure = without_form(plan.map, plan.terms, plan.threads);
  plan.before = map_statistics(plan.figure, {}, plan.threads);
  progress.report(fmt::format("map: {} x {} pixels of {:.4g} mm, {} in the aperture, RMS {:.4g} nm", plan.map.grid.rows,
                              plan.map.grid.cols, plan.map.grid.pitch_x, plan.before.valid_pixels, plan.before.rms));
  plan.tif = load_removal_function(o, plan.inputs);
  check_tool_fits(plan.tif, plan.map.grid);
  plan.kernel = removal_kernel(plan.tif, plan.map.grid.pitch_x, plan.map.grid.pitch_y);
  progress.check();
  return plan;
}

void lay_path(Plan& plan, const Progress& progress) {
  const JobOptions& o = plan.options;
  if (o.path.empty())
    throw InputError("--path: required; for instance raster:pitch=1, nearest:cell=2 or file:path.csv");
  plan.motion = parse_motion(o.motion);
  const PathSpec spec = parse_path_spec(o.path);
  plan.path = rounded(plan_path(spec, {plan.figure, plan.tif, feed_limits(o).max_feed, true, progress}));
  progress.check();
  if (const auto* file = spec.get_if<PathFromFile>()) {
    plan.inputs.push_back({"path", file->file.string(), sha256_of_file(file->file)});
  }
  plan.metrics = path_metrics(plan.path, progress);
  plan.strokes = strokes_of(plan.path, plan.motion);
  progress.report(fmt::format("path: {} dwell points, {:.4g} mm", plan.path.size(), plan.metrics.length));
}

void find_dwell(Plan& plan, const Progress& progress) {
  if (weights_are_searched(plan.options)) plan.search.emplace();
  solve_dwell(plan, progress);
  schedule_feed(plan);
}

Plan prepare_plan(const JobOptions& options, const Progress& progress) {
  Plan plan = read_inputs(options, progress);
  lay_path(plan, progress);
  progress.check();
  return plan;
}

Plan make_plan(const JobOptions& options, const Progress& progress) {
  weights_are_searched(options);  // refuses what cannot be searched before any work is done
  Plan plan = prepare_plan(options, progress);
  find_dwell(plan, progress);
  return plan;
}

}  // namespace dwell
