/// Several tools as one problem, against its optimality conditions in dense algebra.

#include "runs/tools/joint_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/lattice_choice.h"
#include "tests/core/base/expect_error.h"
#include "tests/oracle/dense_algebra.h"
#include "tests/runs/tools/two_tools.h"

namespace dwell {
namespace {

using test::two_tools;
using test::worked_surface;

/// The removal of a second at every dwell point, a column each, on the map's finite pixels: by simulation.
Eigen::MatrixXd removal_columns(const JointTool& tool) {
  const Part& part = *tool.part;
  const std::vector<Index> pixels = finite_pixels(part.map);
  const RemovalKernel kernel = choose_lattice(part, tool.laid.strokes, {}).kernel;
  Eigen::MatrixXd columns(static_cast<Index>(pixels.size()), static_cast<Index>(tool.laid.strokes.size()));
  for (std::size_t j = 0; j < tool.laid.strokes.size(); ++j) {
    const Stroke& s = tool.laid.strokes[j];
    const double length = s.length(), half = distance(s.start, s.via);
    Program one;
    for (const auto& [from, to] : {std::pair(s.start, s.via), std::pair(s.via, s.finish)}) {
      ProgramStep step;
      step.start = from, step.finish = to, step.removes = true;
      step.seconds = (from == s.start ? half : length - half) / length;
      if (step.seconds > 0.0) one.steps.push_back(step);
    }
    const HeightMap removed = simulate(one, part.map, kernel, 1);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      columns(static_cast<Index>(i), static_cast<Index>(j)) = removed.values[static_cast<std::size_t>(pixels[i])];
  }
  return columns;
}

/// The surface's heights and its form terms: piston and tilt.
Eigen::MatrixXd heights_and_form(const HeightMap& map) {
  const std::vector<Index> pixels = finite_pixels(map);
  Eigen::MatrixXd all(static_cast<Index>(pixels.size()), 4);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Point p = map.grid.centre(pixels[i]);
    all.row(static_cast<Index>(i)) << map.values[static_cast<std::size_t>(pixels[i])], 1.0, p.x, p.y;
  }
  return all;
}

/// The derivative of a tool's own part of the objective, given the residual A t - z without form terms.
Vector gradient_of(const JointTool& tool, const Eigen::MatrixXd& columns, const Vector& residual, const Vector& seconds,
                   const Vector& least, double smoothness, double price) {
  const Eigen::MatrixXd steps = path_smoothness(tool.laid.path, tool.laid.strokes, 1).dense_normal();
  const RemovalKernel kernel = choose_lattice(*tool.part, tool.laid.strokes, {}).kernel;
  const double energy = tool.part->kernel.energy;
  EXPECT_GT(kernel.energy, 0.0);
  return columns.transpose() * residual + smoothness * energy * (steps * (seconds - least)) +
         Vector::Constant(seconds.size(), price * tool.price * static_cast<double>(residual.size()));
}

TEST(JointProblem, IsSolvedToItsOptimum) {
  constexpr double kPrice = 2e-3;
  const std::vector<JointTool> tools = two_tools(SolverKind::DenseNnls);
  JointProblem problem(tools);
  const JointDwell found = problem.solve({0, 1}, kPrice, 100.0, "test");
  ASSERT_TRUE(found.solver.converged()) << found.solver.message;
  EXPECT_TRUE(found.certificate.passes(1e-6));
  const Eigen::MatrixXd z = heights_and_form(tools[0].part->map);
  std::vector<Eigen::MatrixXd> columns;
  Vector left = -z.col(0);
  for (std::size_t k = 0; k < 2; ++k) {
    columns.push_back(removal_columns(tools[k]));
    left += columns[k] * found.seconds[k];
  }
  const Eigen::MatrixXd form = z.rightCols(3);
  left -= form * oracle::least_squares_by_qr(form, left);
  EXPECT_NEAR(found.residual_rms, left.norm() / std::sqrt(static_cast<double>(left.size())), 1e-6 * found.residual_rms);
  Index free = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector& t = found.seconds[k];
    const Vector least = test::least_seconds(tools[k]);
    const Vector g = gradient_of(tools[k], columns[k], left, t, least, problem.smoothness(k), kPrice);
    const double scale = (columns[k].transpose() * z.col(0)).cwiseAbs().maxCoeff();
    for (Index j = 0; j < t.size(); ++j) {
      EXPECT_GE(t[j], least[j] * (1.0 - 1e-12));
      if (t[j] > least[j] * (1.0 + 1e-9)) {
        EXPECT_NEAR(g[j], 0.0, 1e-6 * scale) << tools[k].name << ' ' << j;
        ++free;
      } else {
        EXPECT_GT(g[j], -1e-6 * scale) << tools[k].name << ' ' << j;
      }
    }
  }
  EXPECT_GT(free, 40);
}

/// At the joint optimum a plan for one tool, on what the other leaves, finds the same dwell.
TEST(JointProblem, LeavesEachToolItsOwnOptimum) {
  constexpr double kPrice = 2e-3;
  const std::vector<JointTool> tools = two_tools(SolverKind::DenseNnls);
  JointProblem problem(tools);
  const JointDwell found = problem.solve({0, 1}, kPrice, 100.0, "test");
  for (const std::size_t k : {0u, 1u}) {
    const JointTool& other = tools[1 - k];
    const Vector& t = found.seconds[1 - k];
    const Program run = program_of(other.laid.path, {t.begin(), t.end()}, Motion::Moving, 50.0);
    const HeightMap removed =
        simulate(run, worked_surface(), choose_lattice(*other.part, other.laid.strokes, {}).kernel, 1);
    const Part part = make_part(surface_after(worked_surface(), removed), tools[k].part->tif, {true, true}, 1);
    DwellOptions options = tools[k].options;
    options.smoothness = {problem.smoothness(k)};
    options.time_price = {kPrice * tools[k].price};
    const DwellPlan alone = find_dwell(part, tools[k].laid, options);
    EXPECT_LE((alone.seconds - found.seconds[k]).norm(), 1e-3 * found.seconds[k].norm()) << tools[k].name;
    EXPECT_NEAR(alone.residual.rms, found.residual_rms, 1e-4 * found.residual_rms);
  }
}

TEST(JointProblem, IsSolvedByAutoAsWell) {
  JointProblem dense(two_tools(SolverKind::DenseNnls)), fast(two_tools(SolverKind::Auto));
  const JointDwell a = dense.solve({0, 1}, 2e-3, 100.0, "test"), b = fast.solve({0, 1}, 2e-3, 100.0, "test");
  EXPECT_LE(b.cost, 1.01 * a.cost);
  EXPECT_GE(b.cost, (1.0 - 1e-9) * a.cost);
  EXPECT_LT(b.solver.operator_applications, 60);
}

/// Prices and rates far apart make the problem no harder.
TEST(JointProblem, IsSolvedByAutoWithPricesAndRatesFarApart) {
  for (const double price : {0.01, 100.0}) {
    std::vector<JointTool> tools = two_tools(SolverKind::Auto);
    tools[1].price = price;
    JointProblem fast(tools);
    for (JointTool& tool : tools) tool.options.solver = SolverKind::DenseNnls;
    JointProblem dense(tools);
    const JointDwell b = fast.solve({0, 1}, 1e-3, 100.0, "test"), a = dense.solve({0, 1}, 1e-3, 100.0, "test");
    EXPECT_TRUE(a.solver.converged() && b.solver.converged()) << b.solver.message;
    EXPECT_LE(b.cost, 1.02 * a.cost) << price;
    EXPECT_LE(a.certificate.lower_bound, (1.0 + 1e-9) * a.certificate.objective);
    EXPECT_GE(a.certificate.lower_bound, 0.5 * a.certificate.objective);
  }
  std::vector<JointTool> weak = test::two_tools(SolverKind::Auto, 0.04);
  JointProblem fast(weak);
  for (JointTool& tool : weak) tool.options.solver = SolverKind::DenseNnls;
  JointProblem dense(weak);
  const JointDwell b = fast.solve({0, 1}, 1e-5, 100.0, "test"), a = dense.solve({0, 1}, 1e-5, 100.0, "test");
  EXPECT_TRUE(b.solver.converged()) << b.solver.message;
  EXPECT_LE(b.cost, 1.02 * a.cost);
}

/// A tool too sharp for the map's pixels is on a lattice that divides them, and so is then the other.
TEST(JointProblem, PutsToolsOfDifferentLatticesOnOne) {
  std::vector<JointTool> tools = two_tools(SolverKind::Auto);
  JointTool& sharp = tools[1];
  sharp.part =
      std::make_shared<const Part>(make_part(worked_surface(), gaussian_removal(8.0, 0.6, 1.0), sharp.part->form, 1));
  const auto division_of = [](const JointTool& tool) {
    return choose_lattice(*tool.part, tool.laid.strokes, {}).kernel.division;
  };
  ASSERT_NE(division_of(tools[0]).x, division_of(sharp).x);
  JointProblem problem(tools);
  const JointDwell both = problem.solve({0, 1}, 1e-4, 100.0, "test"), alone = problem.solve({0}, 1e-4, 100.0, "test");
  EXPECT_TRUE(both.solver.converged()) << both.solver.message;
  EXPECT_LT(both.residual_rms, alone.residual_rms);
  DwellOptions options = tools[0].options;
  options.smoothness = {problem.smoothness(0)};
  options.time_price = {1e-4};
  const DwellPlan plan = find_dwell(*tools[0].part, tools[0].laid, options);
  EXPECT_NEAR(alone.residual_rms, plan.residual.rms, 0.01 * plan.residual.rms);
}

TEST(JointProblem, OfOneToolIsItsPlan) {
  JointProblem problem(two_tools(SolverKind::DenseNnls));
  const JointTool& tool = problem.tools()[1];
  const JointDwell found = problem.solve({1}, 1e-3, 100.0, "test");
  DwellOptions options = tool.options;
  options.smoothness = {problem.smoothness(1)};
  options.time_price = {tool.price * 1e-3};
  const DwellPlan plan = find_dwell(*tool.part, tool.laid, options);
  EXPECT_LE((plan.seconds - found.seconds[0]).norm(), 1e-6 * plan.seconds.norm());
}

TEST(JointProblem, FindsAPriceByTheRulesOfAPlan) {
  JointProblem problem(two_tools(SolverKind::Auto));
  const TimePrice found = problem.find_price({});
  EXPECT_GT(found.price, 0.0);
  const JointDwell at = problem.solve({0, 1}, found.price, 100.0, "test");
  double priced = 0.0;
  for (const std::size_t k : {0u, 1u}) priced += problem.tools()[k].price * at.seconds[k].sum();
  const RuledPrice ruled =
      worth_of_time({}, {0.5 * found.least.residual_rms * found.least.residual_rms, found.least.total},
                    {0.5 * at.residual_rms * at.residual_rms, priced});
  EXPECT_NEAR(ruled.price, found.price, 0.1 * found.price);
}

TEST(JointProblem, RefusesWhatIsForOneTool) {
  std::vector<JointTool> tools = two_tools(SolverKind::Auto);
  tools[1].options.smoothness = {0.0, GoalKind::Corner};
  test::expect_input_error([&] { JointProblem problem(tools); }, {"'small'", "`smoothness`", "a number or auto"});
  tools[1].options.smoothness = {1.0};
  tools[0].options.fraction = 0.5;
  test::expect_input_error([&] { JointProblem problem(tools); }, {"'large'", "`fraction` is 0.5"});
  tools[0].options.fraction = 1.0;
  tools[0].options.solver = SolverKind::Fourier;
  test::expect_input_error([&] { JointProblem problem(tools); }, {"fourier"});
}

}  // namespace
}  // namespace dwell
