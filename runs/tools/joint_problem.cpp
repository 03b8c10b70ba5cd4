#include "runs/tools/joint_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "core/form/form.h"
#include "core/removal/removal_geometry.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/usual_smoothness.h"
#include "solvers/matched/time_price.h"
#include "solvers/proof.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

/// The geometry of a tool that removes so many times as much in a second.
std::shared_ptr<const RemovalGeometry> with_rate_times(std::shared_ptr<const RemovalGeometry> geometry, double factor) {
  if (factor == 1.0) return geometry;
  RemovalGeometry scaled = *geometry;
  std::vector<double> coefficients = scaled.kernel.surface.coefficients();
  for (double& c : coefficients) c *= factor;
  scaled.kernel.surface = SplineSurface::with_coefficients(scaled.kernel.surface.grid(), std::move(coefficients));
  scaled.kernel.energy *= factor * factor;
  return std::make_shared<const RemovalGeometry>(std::move(scaled));
}

/// What an even dwell with a tool removes, in the mean square over the part, up to a factor that all tools share.
double strength_of(const JointTool& tool) {
  double volume = 0.0;
  for (const double c : tool.part->kernel.surface.coefficients()) volume += c;
  return volume * std::sqrt(static_cast<double>(tool.laid.strokes.size()));
}

/// The kernel of each tool on the lattice that holds it; where they divide the map's pixels differently, on one that
/// divides them as finely as any does, since solvers stack tools on the same pixels alone.
std::vector<RemovalKernel> kernels_on_one_lattice(const std::vector<JointTool>& tools, const Progress& progress) {
  std::vector<RemovalKernel> kernels;
  kernels.reserve(tools.size());
  PixelDivision finest;
  for (const JointTool& tool : tools) {
    kernels.push_back(choose_lattice(*tool.part, tool.laid.strokes, progress.of_part(tool.name + ": lattice")).kernel);
    finest = {std::max(finest.x, kernels.back().division.x), std::max(finest.y, kernels.back().division.y)};
  }
  for (std::size_t k = 0; k < tools.size(); ++k) {
    if (kernels[k].division == finest) continue;
    const Grid& grid = tools[k].part->map.grid;
    kernels[k] = pixel_kernel(tools[k].part->tif, grid.pitch_x, grid.pitch_y, finest);
  }
  return kernels;
}

void check_options(const JointTool& tool) {
  const DwellOptions& o = tool.options;
  const auto refuse = [&tool](const std::string& what) {
    throw InputError(fmt::format("several tools, '{}': {}", tool.name, what));
  };
  if (o.smoothness.kind != GoalKind::Fixed && o.smoothness.kind != GoalKind::Auto)
    refuse("`smoothness` is searched over plans, which is for one tool; required a number or auto");
  if (o.time_price.kind != GoalKind::Fixed && o.time_price.kind != GoalKind::Auto &&
      o.time_price.kind != GoalKind::TotalAtMost)
    refuse("`time price` is searched over plans, which is for one tool; required a number, auto or total<=SECONDS");
  if (o.fraction != 1.0) refuse(fmt::format("`fraction` is {}; required 1", o.fraction));
  if (o.solver == SolverKind::Fourier) refuse("`solver` is fourier, which knows one tool; required another");
  if (!(tool.price > 0.0) || !std::isfinite(tool.price) || !(tool.change_over >= 0.0) ||
      !std::isfinite(tool.change_over)) {
    throw std::invalid_argument("JointProblem: price <= 0 or change-over < 0");
  }
}

/// What the least dwell leaves of the objective's squares [nm^2]. One operator application.
double square_at_least(const DwellProblem& problem) {
  Vector residual;
  DwellObjective(problem).residual(problem.lower, residual);
  return residual.squaredNorm();
}

}  // namespace

JointProblem::JointProblem(std::vector<JointTool> tools, const Progress& progress) : tools_(std::move(tools)) {
  if (tools_.empty()) throw std::invalid_argument("JointProblem: no tool");
  for (const JointTool& tool : tools_) check_options(tool);
  const std::vector<RemovalKernel> kernels = kernels_on_one_lattice(tools_, progress);
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    const JointTool& tool = tools_[k];
    if (tool.part->map.grid != tools_.front().part->map.grid)
      throw std::invalid_argument("JointProblem: tools on different maps");
    add(tool, kernels[k], progress.of_part(tool.name));
  }
}

void JointProblem::add(const JointTool& tool, const RemovalKernel& kernel, const Progress& progress) {
  const Part& part = *tool.part;
  progress.step("setting up the removal operator");
  PlanProblem own(part, tool.laid, kernel, tool.options, progress);
  const WeightGoal& goal = tool.options.smoothness;
  const double smoothness = goal.kind == GoalKind::Auto ? usual_smoothness(part, tool.laid) : goal.value;
  const DwellProblem& problem = own.with({smoothness, 0.0});
  if (pieces_.empty()) {
    const std::vector<Index> pixels = finite_pixels(part.map);
    Vector heights(static_cast<Index>(pixels.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
      heights[static_cast<Index>(i)] = part.map.values[static_cast<std::size_t>(pixels[i])];
    common_.rows = problem.rows;
    common_.form = problem.form;
    common_.weights = problem.weights;
    if (common_.rows) {
      common_.rows->apply(heights, common_.target);
    } else {
      common_.target = std::move(heights);
    }
  }
  const DwellPart& stretch = problem.parts.front();
  const double scale = strength_of(tool) / strength_of(tools_.front());
  pieces_.push_back({with_rate_times(stretch.geometry, 1.0 / scale), stretch.smoothness, smoothness,
                     problem.alpha / (scale * scale), scale, scale * problem.lower, common_.target - problem.target});
}

JointProblem::Stack JointProblem::stack(const std::vector<std::size_t>& tools) const {
  Stack stack;
  stack.problem = common_;
  std::vector<std::shared_ptr<const RemovalGeometry>> geometries;
  Index points = 0;
  for (const std::size_t k : tools) points += pieces_[k].lower.size();
  stack.problem.lower.resize(points);
  Index first = 0;
  for (const std::size_t k : tools) {
    const Piece& piece = pieces_[k];
    geometries.push_back(piece.geometry);
    stack.problem.parts.push_back({piece.geometry, piece.smoothness, piece.alpha, tools_[k].price / piece.scale});
    stack.problem.lower.segment(first, piece.lower.size()) = piece.lower;
    stack.problem.target -= piece.moved;
    first += piece.lower.size();
  }
  stack.removal = make_removal_operator(geometries);
  stack.problem.removal = stack.removal.get();
  if (common_.rows) {
    stack.rows = std::make_unique<RowsOfRemoval>(*stack.removal, *common_.rows);
    stack.problem.removal = stack.rows.get();
  }
  return stack;
}

TimePrice JointProblem::find_price(const TimeWorth& worth, const Progress& progress) {
  std::vector<std::size_t> all(tools_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Stack together = stack(all);
  if (!common_.rows) return find_time_price(together.problem, worth, progress);
  // As PlanProblem::find_price: of heights, in the measure of the slopes.
  std::vector<JointTool> in_heights = tools_;
  for (JointTool& tool : in_heights) tool.options.objective = {};
  JointProblem heights(std::move(in_heights), progress);
  Stack other = heights.stack(all);
  TimePrice price = find_time_price(other.problem, worth, progress);
  const double square = square_at_least(other.problem);
  if (square > 0.0) price.price *= square_at_least(together.problem) / square;
  return price;
}

double JointProblem::least_total(const std::vector<std::size_t>& tools) const {
  double sum = 0.0;
  for (const std::size_t k : tools) sum += pieces_[k].lower.sum() / pieces_[k].scale + tools_[k].change_over;
  return sum;
}

JointDwell JointProblem::solve(const std::vector<std::size_t>& tools, double price, double max_seconds,
                               const std::string& stage, const Progress& progress) {
  progress.check();
  Stack set = stack(tools);
  DwellProblem& problem = set.problem;
  const auto pixels = static_cast<double>(problem.pixels());
  problem.gamma = price * pixels;
  SolverOptions options;
  options.kind = tools_.front().options.solver;
  options.max_seconds = max_seconds;
  options.progress = progress.of_part(stage);
  JointDwell found;
  found.tools = tools;
  Vector t;
  found.solver = make_solver(options)->solve(problem, t);
  progress.check();
  options.max_seconds = std::max(1e-9, max_seconds - found.solver.seconds);
  doubt_settled(problem, std::move(options), t, found.solver);
  progress.check();
  if (!found.solver.usable()) {
    throw std::runtime_error(
        fmt::format("solver {}: {}", to_string(tools_.front().options.solver), found.solver.message));
  }
  found.certificate = certify(problem, t);
  Vector residual;
  DwellObjective objective(problem);
  objective.residual(t, residual);
  found.residual_rms = residual.norm() / std::sqrt(pixels);
  found.cost = objective.value(residual, t) / pixels;
  found.price = price;
  Index first = 0;
  for (const std::size_t k : tools) {
    const Index points = pieces_[k].lower.size();
    found.seconds.emplace_back(t.segment(first, points) / pieces_[k].scale);
    const double seconds = found.seconds.back().sum(), change_over = tools_[k].change_over;
    found.total += seconds + change_over;
    found.time_cost += price * tools_[k].price * (seconds + change_over);
    found.cost += price * tools_[k].price * change_over;
    first += points;
  }
  return found;
}

}  // namespace dwell
