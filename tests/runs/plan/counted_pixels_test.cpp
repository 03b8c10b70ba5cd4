#include "runs/plan/counted_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/form/form.h"
#include "core/removal/simulate.h"
#include "core/removal/sparse_removal.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/plan_problem.h"
#include "tests/core/base/expect_error.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// A part of 14 x 11 mm without symmetry, a corner missing.
HeightMap weighted_map() {
  HeightMap map(Grid{28, 36, 0.4, 0.4, {-4.25, 1.75}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const bool missing = i / map.grid.cols + i % map.grid.cols < 5;
    map.values[static_cast<std::size_t>(i)] = missing
                                                  ? std::numeric_limits<double>::quiet_NaN()
                                                  : 20.0 * std::sin(0.4 * p.x) * std::cos(0.3 * p.y + 0.2) +
                                                        0.3 * p.x * p.y + 2.0 * std::sin(static_cast<double>(7 * i));
  }
  return map;
}

/// Large where x is, 0 in a stripe.
std::vector<double> some_weights(const Grid& grid) {
  std::vector<double> weights;
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    weights.push_back(p.y > 10.0 ? 0.0 : 0.5 + 0.2 * (p.x + 5.0));
  }
  return weights;
}

const RemovalFunction& the_tool() {
  static const RemovalFunction kTool = gaussian_removal(10.0, 2.5, 4.0);
  return kTool;
}

Part weighted_part(std::vector<double> weights) {
  return make_part(weighted_map(), the_tool(), {true, true}, 1, {}, std::move(weights));
}

DwellOptions the_options(SolverKind solver = SolverKind::Auto) {
  DwellOptions options;
  options.smoothness = {0.02};
  options.time_price = {1e-3};
  options.solver = solver;
  return options;
}

LaidPath the_path(const Part& part) {
  return lay_path(part, parse_path_spec("raster:pitch=1.2,overrun=2"), Motion::Moving, 50.0);
}

TEST(CountedPixels, OfWeightZeroAreAsIfNotMeasuredButKept) {
  const std::vector<double> weights = some_weights(weighted_map().grid);
  const Part part = weighted_part(weights);
  HeightMap cut = weighted_map();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) cut.values[i] = std::nan("");
  }
  const Part other = make_part(cut, the_tool(), {true, true}, 1);
  EXPECT_EQ(part.before.valid_pixels, other.before.valid_pixels);
  EXPECT_EQ(part.before.rms, other.before.rms);
  EXPECT_EQ(the_path(part).path.points.size(), the_path(other).path.points.size());
  Index beside = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const bool measured = std::isfinite(weighted_map().values[i]), counts = measured && weights[i] > 0.0;
    EXPECT_EQ(std::isfinite(part.map.values[i]), counts);
    EXPECT_EQ(std::isfinite(part.beside.values[i]), measured && !counts);
    beside += measured && !counts ? 1 : 0;
  }
  EXPECT_GT(beside, 50);
}

TEST(CountedPixels, OfOneWeightAreAllTheSame) {
  std::vector<double> weights(static_cast<std::size_t>(weighted_map().grid.size()), 7.0);
  const Part part = weighted_part(weights);
  EXPECT_TRUE(part.weights.empty());
  EXPECT_TRUE(part.beside.values.empty());
  EXPECT_FALSE(weighted_rms(part, part.figure));
  weights.assign(weights.size(), 0.0);
  expect_input_error([&] { weighted_part(weights); }, {"no pixel", "weight above 0"});
  weights[40] = -1.0;
  EXPECT_THROW(weighted_part(weights), std::invalid_argument);
  EXPECT_THROW(weighted_part({1.0}), std::invalid_argument);
}

TEST(CountedPixels, HaveAWeightedRmsAboutTheirWeightedForm) {
  const Part part = weighted_part(some_weights(weighted_map().grid));
  const std::vector<Index> pixels = finite_pixels(part.map);
  Eigen::MatrixXd terms(static_cast<Index>(pixels.size()), 3);
  Eigen::VectorXd z(terms.rows()), root(terms.rows());
  for (Index i = 0; i < terms.rows(); ++i) {
    const Index pixel = pixels[static_cast<std::size_t>(i)];
    const Point p = part.map.grid.centre(pixel);
    root[i] = std::sqrt(some_weights(part.map.grid)[static_cast<std::size_t>(pixel)]);
    z[i] = root[i] * part.figure.values[static_cast<std::size_t>(pixel)];
    terms.row(i) = root[i] * Eigen::RowVector3d(1.0, p.x, p.y);
  }
  const double expected = (z - terms * oracle::least_squares_by_qr(terms, z)).norm() / root.norm();
  ASSERT_TRUE(weighted_rms(part, part.figure));
  EXPECT_NEAR(*weighted_rms(part, part.figure), expected, 1e-9 * expected);
  EXPECT_GT(std::abs(expected - part.before.rms), 0.01 * expected);  // another figure than the plain one
}

/// The plan against the minimiser of 1/2 sum w (A t - z - form)^2 + penalties, from dense algebra alone.
TEST(CountedPixels, AreFittedByWeightedLeastSquares) {
  const Part part = weighted_part(some_weights(weighted_map().grid));
  const LaidPath laid = the_path(part);
  PlanProblem problem(part, laid, part.kernel, the_options(SolverKind::DenseNnls));
  const WeightedDwell found = problem.solve({0.02, 1e-3}, {}, 100.0, "test", {});
  ASSERT_TRUE(found.solver.converged()) << found.solver.message;
  const std::vector<Index> pixels = finite_pixels(part.map);
  const auto m = static_cast<Index>(pixels.size()), n = static_cast<Index>(laid.strokes.size());
  Eigen::MatrixXd columns(m, n + 4);
  double sum = 0.0;
  for (const Index pixel : pixels) sum += part.weights[static_cast<std::size_t>(pixel)];
  for (Index j = 0; j < n; ++j) {
    const HeightMap left = problem.left_by(Vector::Unit(n, j));
    for (Index i = 0; i < m; ++i) {
      const auto k = static_cast<std::size_t>(pixels[static_cast<std::size_t>(i)]);
      columns(i, j) = part.map.values[k] - left.values[k];
    }
  }
  for (Index i = 0; i < m; ++i) {
    const Index pixel = pixels[static_cast<std::size_t>(i)];
    const Point p = part.map.grid.centre(pixel);
    columns.row(i).tail(4) << part.map.values[static_cast<std::size_t>(pixel)], 1.0, p.x, p.y;
    columns.row(i) *= std::sqrt(part.weights[static_cast<std::size_t>(pixel)] * static_cast<double>(m) / sum);
  }
  const Eigen::MatrixXd form = columns.rightCols(3), rest = columns.leftCols(n + 1);
  const Eigen::MatrixXd fitted = rest - form * oracle::least_squares_by_qr(form, rest);
  const Eigen::MatrixXd smooth = 0.02 * part.kernel.energy * path_smoothness(laid.path, laid.strokes, 1).dense_normal();
  const Eigen::VectorXd lower = Eigen::VectorXd::Constant(n, found.dwell.minCoeff());
  const Eigen::VectorXd& t = found.dwell;
  const Eigen::VectorXd residual = fitted.leftCols(n) * t - fitted.col(n);
  EXPECT_NEAR(found.trade_off.residual_rms, residual.norm() / std::sqrt(static_cast<double>(m)), 1e-9);
  // The gradient vanishes where the dwell is free, and pushes down where it is at its least.
  const Eigen::VectorXd least = problem.with({0.02, 1e-3}).lower;
  const Eigen::VectorXd g = fitted.leftCols(n).transpose() * residual + smooth * (t - least) +
                            Eigen::VectorXd::Constant(n, 1e-3 * static_cast<double>(m));
  const double scale = (fitted.leftCols(n).transpose() * fitted.col(n)).cwiseAbs().maxCoeff();
  Index free = 0;
  for (Index j = 0; j < n; ++j) {
    if (t[j] > least[j] * (1.0 + 1e-9)) {
      EXPECT_NEAR(g[j], 0.0, 1e-6 * scale) << j;
      ++free;
    } else {
      EXPECT_GT(g[j], -1e-6 * scale) << j;
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_LT(free, n);
}

TEST(CountedPixels, CountByTheRatiosOfTheirWeightsAlone) {
  std::vector<double> weights = some_weights(weighted_map().grid);
  const Part one = weighted_part(weights);
  for (double& w : weights) w *= 64.0;
  const Part other = weighted_part(weights);
  const LaidPath laid = the_path(one);
  EXPECT_LT((find_dwell(one, laid, the_options()).seconds - find_dwell(other, laid, the_options()).seconds).norm(),
            1e-9);
  expect_input_error([&] { find_dwell(one, laid, the_options(SolverKind::Fourier)); }, {"`weight`", "fourier"});
}

TEST(CountedPixels, GetLessLeftWhereTheyWeighMore) {
  const Part plain = make_part(weighted_map(), the_tool(), {true, true}, 1);
  const LaidPath laid = the_path(plain);
  const auto rms_right = [](const HeightMap& left) {
    HeightMap half = left;
    for (Index i = 0; i < half.grid.size(); ++i) {
      if (half.grid.centre(i).x < 4.0) half.values[static_cast<std::size_t>(i)] = std::nan("");
    }
    return map_statistics(half, {true, true}).rms;
  };
  std::vector<double> weights;
  for (Index i = 0; i < plain.map.grid.size(); ++i) weights.push_back(plain.map.grid.centre(i).x < 4.0 ? 0.02 : 1.0);
  const double all = rms_right(find_dwell(plain, laid, the_options()).exact.surface);
  const double right = rms_right(find_dwell(weighted_part(weights), laid, the_options()).exact.surface);
  EXPECT_LT(right, 0.9 * all);
}

TEST(CountedPixels, AreShownWithTheOthers) {
  const Part part = weighted_part(some_weights(weighted_map().grid));
  const LaidPath laid = the_path(part);
  const DwellPlan plan = find_dwell(part, laid, the_options());
  const std::vector<double> seconds(plan.seconds.begin(), plan.seconds.end());
  const Program program = program_of(laid.path, seconds, laid.motion, 50.0);
  const HeightMap shown = shown_surface(part, plan.exact.surface, program, part.kernel);
  const HeightMap whole = surface_after(weighted_map(), simulate(program, weighted_map(), part.kernel, 1));
  // The form that is removed there is that of the pixels that count: a plane through whole - shown.
  Eigen::MatrixXd terms(whole.grid.size(), 3);
  Eigen::VectorXd plane = Eigen::VectorXd::Zero(whole.grid.size());
  terms.setZero();
  for (Index i = 0; i < whole.grid.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    ASSERT_EQ(std::isfinite(shown.values[k]), std::isfinite(whole.values[k]));
    if (!std::isfinite(whole.values[k])) continue;
    terms.row(i) << 1.0, whole.grid.centre(i).x, whole.grid.centre(i).y;
    plane[i] = whole.values[k] - shown.values[k];
  }
  const Eigen::VectorXd rest = plane - terms * oracle::least_squares_by_qr(terms, plane);
  EXPECT_LT(rest.cwiseAbs().maxCoeff(), 0.05 * plan.exact.statistics.rms);  // the error of the lattice
  EXPECT_GT(plane.cwiseAbs().maxCoeff(), 1.0);
  // A figure of all of it is the map less the form of what counts.
  const HeightMap figure = shown_figure(part);
  for (Index i = 0; i < whole.grid.size(); ++i)
    plane[i] = std::isfinite(weighted_map().values[static_cast<std::size_t>(i)])
                   ? weighted_map().values[static_cast<std::size_t>(i)] - figure.values[static_cast<std::size_t>(i)]
                   : 0.0;
  EXPECT_LT((plane - terms * oracle::least_squares_by_qr(terms, plane)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace dwell
