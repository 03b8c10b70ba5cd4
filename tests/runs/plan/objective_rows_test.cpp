#include "runs/plan/objective_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/map/surface_slope.h"
#include "runs/plan/counted_pixels.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/usual_smoothness.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// Waves of many lengths, the short ones finer than the tool, with a missing corner.
HeightMap map_of_waves() {
  HeightMap map(Grid{50, 64, 0.3, 0.25, {2.0, -3.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = i / map.grid.cols + i % map.grid.cols < 12
                                                  ? std::nan("")
                                                  : 20.0 * std::sin(0.35 * p.x) * std::cos(0.3 * p.y) +
                                                        3.0 * std::sin(1.3 * p.x + 0.4) * std::cos(1.1 * p.y) +
                                                        2.0 * p.x;
  }
  return map;
}

Part part_of_waves(const FormTerms& form = {true, true}) {
  return make_part(map_of_waves(), gaussian_removal(5.0, 2.5, 4.0), form, 1);
}

/// W P R z for the heights of a map.
Vector residual_of(const ObjectiveRows& rows, const HeightMap& map) {
  const std::vector<Index> pixels = finite_pixels(map);
  Vector z(static_cast<Index>(pixels.size())), r;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    z[static_cast<Index>(i)] = map.values[static_cast<std::size_t>(pixels[i])];
  rows.rows->apply(z, r);
  r.array() *= rows.weights.array();
  r -= rows.form * (rows.form.transpose() * r);
  return r;
}

TEST(FitObjective, IsParsedFromWhatItSays) {
  EXPECT_EQ(parse_fit_objective("height").slope_share, 0.0);
  EXPECT_EQ(parse_fit_objective("slope").slope_share, 1.0);
  EXPECT_EQ(parse_fit_objective("mixed:0.25").slope_share, 0.25);
  for (const char* text : {"height", "slope", "mixed:0.25"}) EXPECT_EQ(to_string(parse_fit_objective(text)), text);
  for (const char* text :
       {"", "slopes", "mixed", "mixed:", "mixed:0", "mixed:1", "mixed:nan", "mixed:0.5urad", "mixed:50%"})
    expect_input_error([&] { parse_fit_objective(text); }, {text, "height, slope or mixed:SHARE"});
}

// Held against the statistics of the map, which take RMS and slopes in loops of their own.
TEST(ObjectiveRows, MakeTheSquaresThatTheObjectiveSays) {
  const Part part = part_of_waves({});
  const MapStatistics heights = map_statistics(part.map, {});
  const SlopeStatistics slopes = slope_statistics(part.map);
  const double length = slope_length(part), m = static_cast<double>(part.map.valid_pixels());
  EXPECT_NEAR(length, kHalfHeldWave * equivalent_fwhm(part) / (2.0 * std::numbers::pi), 1e-12);
  for (const double share : {0.25, 1.0}) {
    const ObjectiveRows rows = objective_rows(part, finite_pixels(part.map), {}, {share});
    EXPECT_EQ(rows.form.cols(), 0);
    const double expected =
        m * ((1.0 - share) * std::pow(heights.rms_about_zero(), 2) + share * std::pow(length * slopes.total, 2));
    EXPECT_NEAR(residual_of(rows, part.map).squaredNorm(), expected, 1e-9 * expected);
  }
}

TEST(ObjectiveRows, LeaveOutFormTermsAndTheSlopeOfAPiston) {
  const Part part = part_of_waves();
  const std::vector<Index> pixels = finite_pixels(part.map);
  const ObjectiveRows slope = objective_rows(part, pixels, {}, {1.0}), both = objective_rows(part, pixels, {}, {0.5});
  EXPECT_EQ(slope.form.cols(), 2);
  EXPECT_EQ(both.form.cols(), 3);
  HeightMap tilted = part.map;
  for (Index i = 0; i < tilted.grid.size(); ++i) {
    const Point p = tilted.grid.centre(i);
    tilted.values[static_cast<std::size_t>(i)] += 100.0 - 7.0 * p.x + 3.0 * p.y;
  }
  for (const ObjectiveRows* rows : {&slope, &both}) {
    EXPECT_LT(
        (rows->form.transpose() * rows->form - Eigen::MatrixXd::Identity(rows->form.cols(), rows->form.cols())).norm(),
        1e-12);
    EXPECT_LT((residual_of(*rows, tilted) - residual_of(*rows, part.map)).norm(),
              1e-9 * residual_of(*rows, part.map).norm());
  }
  // Mean slopes are what tilt leaves out of slopes.
  EXPECT_NEAR(residual_of(slope, part.map).head(slope.rows->pairs_x()).sum(), 0.0, 1e-6);
}

TEST(ObjectiveRows, WeighASlopeByTheMeanOfItsPixels) {
  std::vector<double> weights(static_cast<std::size_t>(map_of_waves().grid.size()), 1.0);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1.0 + 0.1 * static_cast<double>(i % 17);
  const Part part = make_part(map_of_waves(), gaussian_removal(5.0, 2.5, 4.0), {}, 1, {}, weights);
  const std::vector<Index> pixels = finite_pixels(part.map);
  const ObjectiveRows rows = objective_rows(part, pixels, weight_roots(part, pixels), {1.0});
  double sum = 0.0, squares = 0.0, all = 0.0;
  for (Index k = 0; k < rows.rows->pairs_x(); ++k) {
    const auto [a, b] = rows.rows->pair(k);
    const double w = 0.5 * (weights[static_cast<std::size_t>(pixels[static_cast<std::size_t>(a)])] +
                            weights[static_cast<std::size_t>(pixels[static_cast<std::size_t>(b)])]);
    squares += std::pow(rows.weights[k] * rows.weights[k] / w, 2);
    sum += rows.weights[k] * rows.weights[k] / w;
    all += rows.weights[k] * rows.weights[k];
  }
  const auto count = static_cast<double>(rows.rows->pairs_x());
  EXPECT_NEAR(squares / count, std::pow(sum / count, 2), 1e-9 * squares / count);  // all ratios are the same
  EXPECT_NEAR(all, static_cast<double>(pixels.size()) * std::pow(slope_length(part), 2), 1e-9 * all);
}

TEST(FitObjective, OfSlopesLeavesSmallerSlopes) {
  const Part part = part_of_waves();
  const LaidPath laid = lay_path(part, parse_path_spec("raster:pitch=0.9,overrun=2.5"), Motion::Moving, 50.0);
  DwellOptions options;
  options.smoothness = {0.001};  // little, so that what is left is the objective's doing
  const DwellPlan by_height = find_dwell(part, laid, options);
  options.objective = {0.5};
  const DwellPlan by_both = find_dwell(part, laid, options);
  options.objective = {1.0};
  const DwellPlan by_slope = find_dwell(part, laid, options);
  // Of slopes about their means, since tilt does not count.
  const ObjectiveRows slopes = objective_rows(part, finite_pixels(part.map), {}, {1.0});
  const double of_one = slope_length(part) * std::sqrt(static_cast<double>(part.map.valid_pixels()));
  const auto slope_of = [&](const DwellPlan& plan) { return residual_of(slopes, plan.exact.surface).norm() / of_one; };
  EXPECT_TRUE(by_slope.solver.converged()) << by_slope.solver.message;
  EXPECT_LT(slope_of(by_slope), 0.98 * slope_of(by_height));
  EXPECT_LE(slope_of(by_slope), slope_of(by_both) * 1.01);
  // What the certificate states is of the objective: L times the slope.
  EXPECT_NEAR(by_slope.certificate.residual_rms, slope_length(part) * slope_of(by_slope),
              0.01 * by_slope.certificate.residual_rms);
}

TEST(FitObjective, OfSlopesRefusesTargetsInHeights) {
  DwellOptions options;
  options.objective = {0.5};
  options.smoothness = {1.0, GoalKind::ResidualAtMost};
  expect_input_error([&] { check_weights(options); }, {"`smoothness`", "residual<=1", "`objective`", "mixed:0.5"});
  options.smoothness = {0.1};
  EXPECT_NO_THROW(check_weights(options));
  options.solver = SolverKind::Fourier;
  expect_input_error([&] { check_weights(options); }, {"`objective` mixed:0.5", "fourier"});
}

}  // namespace
}  // namespace dwell
