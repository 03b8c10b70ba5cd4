#include "runs/plan.h"

#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <utility>

#include "core/aperture.h"
#include "core/errors.h"
#include "core/removal_geometry.h"
#include "core/units.h"
#include "core/whole_file.h"
#include "paths/path_spec.h"
#include "runs/motion.h"
#include "runs/plan_program.h"
#include "runs/simulate.h"

namespace dwell {
namespace {

/// The path with coordinates as the feed table holds them (1e-6 mm), so that what is solved is what is exported.
ToolPath rounded(ToolPath path) {
  constexpr double kPerMm = 1e6;
  for (Point& p : path.points) p = {std::round(p.x * kPerMm) / kPerMm, std::round(p.y * kPerMm) / kPerMm};
  path.lifted[0] = 1;
  return path;
}

void read_inputs(Plan& plan, const RunHooks& hooks) {
  const JobOptions& o = plan.options;
  HeightMap whole = load_map(o, plan.inputs);
  plan.map_pixels = whole.valid_pixels();
  plan.map = within(std::move(whole), parse_aperture(o.aperture));
  plan.terms = parse_form_terms(o.remove);
  plan.figure = without_form(plan.map, plan.terms, plan.threads);
  plan.before = map_statistics(plan.figure, {}, plan.threads);
  hooks.report(fmt::format("map: {} x {} pixels of {:.4g} mm, {} in the aperture, RMS {:.4g} nm", plan.map.grid.rows,
                           plan.map.grid.cols, plan.map.grid.pitch_x, plan.before.valid_pixels, plan.before.rms));
  plan.tif = load_removal_function(o, plan.inputs);
  check_tool_fits(plan.tif, plan.map.grid);
  plan.kernel = removal_kernel(plan.tif, plan.map.grid.pitch_x, plan.map.grid.pitch_y);
}

void lay_path(Plan& plan, const RunHooks& hooks) {
  const JobOptions& o = plan.options;
  if (o.path.empty())
    throw InputError("--path: required; for instance raster:pitch=1, nearest:cell=2 or file:path.csv");
  plan.motion = parse_motion(o.motion);
  const PathSpec spec = parse_path_spec(o.path);
  plan.path = rounded(plan_path(spec, plan.figure, plan.tif.radius));
  if (const auto* file = std::get_if<PathFromFile>(&spec)) {
    plan.inputs.push_back({"path", file->file.string(), sha256_of_file(file->file)});
  }
  plan.metrics = path_metrics(plan.path);
  plan.strokes = strokes_of(plan.path, plan.motion);
  hooks.report(fmt::format("path: {} dwell points, {:.4g} mm", plan.path.size(), plan.metrics.length));
}

std::shared_ptr<const RemovalGeometry> geometry_of(const Plan& plan) {
  return std::make_shared<const RemovalGeometry>(
      RemovalGeometry{plan.map.grid, finite_pixels(plan.map), plan.kernel, plan.strokes, plan.threads});
}

/// What the dwell has to remove: the map, less what the moves between halts remove on their way.
Vector target_of(const Plan& plan, const std::vector<Index>& pixels, double max_feed) {
  HeightMap target = plan.map;
  if (plan.motion == Motion::Stop) {
    const Program moves = program_of(plan.path, std::vector<double>(plan.path.size(), 0.0), Motion::Stop, max_feed);
    target = surface_after(plan.map, simulate(moves, plan.map, plan.kernel, plan.threads));
  }
  Vector z(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    z[static_cast<Index>(i)] = target.values[static_cast<std::size_t>(pixels[i])];
  return z;
}

FeedLimits feed_limits(const JobOptions& o) { return {o.min_dwell_s, units::mm_per_s(o.max_feed_mm_per_min)}; }

DwellProblem problem_of(const Plan& plan, RemovalOperator& removal, std::shared_ptr<const RemovalGeometry> geometry) {
  const std::vector<Index>& pixels = geometry->pixels;
  const JobOptions& o = plan.options;
  const FeedLimits limits = feed_limits(o);
  DwellProblem problem;
  problem.removal = &removal;
  problem.target = target_of(plan, pixels, limits.max_feed);
  problem.form = form_basis(plan.map.grid, pixels, plan.terms, {}, plan.threads);
  problem.smoothness = path_smoothness(plan.path, plan.strokes);
  problem.alpha = o.smoothness * plan.kernel.energy;
  problem.gamma = o.time_price_nm2_per_s * static_cast<double>(pixels.size());
  problem.lower = minimum_dwell(plan.strokes, limits);
  problem.geometry = std::move(geometry);
  return problem;
}

void solve_dwell(Plan& plan, const RunHooks& hooks) {
  const auto geometry = geometry_of(plan);
  const std::vector<Index>& pixels = geometry->pixels;
  hooks.report("solve: removal operator");
  const auto removal = make_removal_operator(*geometry);
  hooks.check();
  hooks.report("solve: target, form and limits");
  const DwellProblem problem = problem_of(plan, *removal, geometry);
  hooks.report(fmt::format("solve: {}", plan.options.solver));
  SolverOptions options;
  options.kind = parse_solver_kind(plan.options.solver);
  options.max_seconds = plan.options.max_solve_s;
  options.progress = [&hooks](const SolverProgress& p) {
    hooks.report(
        fmt::format("solve: iteration {}, residual {:.4g} nm RMS, {:.1f} s", p.iterations, p.residual_rms, p.seconds));
    return !(hooks.stop && hooks.stop());
  };
  plan.solver = make_solver(options)->solve(problem, plan.dwell);
  hooks.check();
  if (!plan.solver.usable()) throw std::runtime_error("solver " + plan.options.solver + ": " + plan.solver.message);
  hooks.report("solve: certificate");
  plan.certificate = certify(problem, plan.dwell);

  Vector removed;
  removal->apply(plan.dwell, removed);
  HeightMap left(plan.map.grid);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto k = static_cast<Index>(i);
    left.values[static_cast<std::size_t>(pixels[i])] = problem.target[k] - removed[k];
  }
  plan.residual = map_statistics(left, plan.terms, plan.threads);
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
  if (plan.feed.segments_infeasible > 0) {
    plan.limits.push_back(fmt::format("{} of {} segments run faster than --max-feed {} mm/min allows",
                                      plan.feed.segments_infeasible, plan.path.size(), o.max_feed_mm_per_min));
  }
}

}  // namespace

int thread_count(int asked) { return asked > 0 ? asked : omp_get_num_procs(); }

Plan make_plan(const JobOptions& options, const RunHooks& hooks) {
  Plan plan;
  plan.options = options;
  plan.threads = thread_count(options.threads);
  read_inputs(plan, hooks);
  hooks.check();
  lay_path(plan, hooks);
  hooks.check();
  solve_dwell(plan, hooks);
  schedule_feed(plan);
  return plan;
}

}  // namespace dwell
