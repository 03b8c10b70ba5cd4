#include "core/removal/simulate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.h"
#include "tests/core/removal/direct_removal.h"

namespace dwell {
namespace {

/// A part with a missing corner, unequal pitches, an origin off zero, and a removal function without any symmetry.
struct Part {
  HeightMap map{Grid{12, 15, 0.5, 0.4, {-3.25, 7.1}}};
  Eigen::MatrixXd samples{7, 7};
  RemovalKernel kernel;

  Part() {
    for (Index i = 20; i < map.grid.size(); ++i) map.values[static_cast<std::size_t>(i)] = 1.0;
    HeightMap rates(Grid{7, 7, 0.5, 0.4, {-1.5, -1.2}});
    for (Index r = 0; r < 7; ++r) {
      for (Index c = 0; c < 7; ++c) {
        const double u = static_cast<double>(c) - 2.4, v = static_cast<double>(r) - 3.7;
        rates.at(r, c) = samples(r, c) = 3.0 * std::exp(-0.3 * u * u - 0.4 * v * v) + 0.02 * static_cast<double>(c * r);
      }
    }
    kernel = removal_kernel(measured_removal(rates, {TifCentre::Kind::Middle, {}}), 0.5, 0.4);
  }

  /// The support is the square about the axis that holds all samples: 1.5 mm, which is 3.75 pixels of 0.4 mm.
  oracle::DirectKernel direct() const {
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(9, 7);
    square.middleRows(1, 7) = samples;
    return {square, 0.5, 0.4};
  }
};

/// Moves in both directions, a halt, a corner, lifted moves, one with a time, and a stretch outside the part.
Program winding_program() {
  Program program;
  program.steps = {{{-2.0, 8.0}, {-0.5, 8.5}, 2.0, true},   {{-0.5, 8.5}, {-0.5, 8.5}, 0.75, true},
                   {{-0.5, 8.5}, {-0.75, 9.9}, 1.25, true}, {{-0.75, 9.9}, {2.0, 10.0}, 0.0, false},
                   {{2.0, 10.0}, {1.0, 9.0}, 3.5, true},    {{1.0, 9.0}, {1.0, 20.0}, 50.0, false},
                   {{-4.5, 7.0}, {-3.9, 7.2}, 4.0, true}};
  return program;
}

TEST(Simulate, MatchesTheDefinitionForMovesHaltsAndLifts) {
  const Part part;
  const Program program = winding_program();
  std::vector<Stroke> strokes;
  std::vector<double> seconds;
  for (const ProgramStep& step : program.steps) {
    if (!step.removes) continue;
    strokes.push_back(
        {step.start, {0.5 * (step.start.x + step.finish.x), 0.5 * (step.start.y + step.finish.y)}, step.finish});
    seconds.push_back(step.seconds);
  }
  const std::vector<Index> pixels = finite_pixels(part.map);
  const Eigen::VectorXd expected =
      oracle::direct_matrix(part.map.grid, pixels, part.direct(), strokes) *
      Eigen::Map<const Eigen::VectorXd>(seconds.data(), static_cast<Eigen::Index>(seconds.size()));
  const HeightMap removal = simulate(program, part.map, part.kernel, 1);
  EXPECT_EQ(removal.grid, part.map.grid);
  EXPECT_EQ(removal.valid_pixels(), static_cast<Index>(pixels.size()));
  double worst = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double error =
        std::abs(removal.values[static_cast<std::size_t>(pixels[i])] - expected[static_cast<Eigen::Index>(i)]);
    ASSERT_TRUE(std::isfinite(error));
    worst = std::max(worst, error);
  }
  EXPECT_GT(expected.maxCoeff(), 1.0);
  EXPECT_LE(worst, 1e-9 * expected.maxCoeff());  // Simpson's rule of the oracle meets the spline's knots
}

TEST(Simulate, ProgramTwiceAsSlowRemovesTwiceAsMuch) {
  const Part part;
  Program program = winding_program();
  const HeightMap once = simulate(program, part.map, part.kernel, 1);
  for (ProgramStep& step : program.steps) step.seconds *= 2.0;
  const HeightMap twice = simulate(program, part.map, part.kernel, 1);
  for (const Index i : finite_pixels(part.map)) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_LE(std::abs(twice.values[k] - 2.0 * once.values[k]), 1e-12 * std::abs(once.values[k]));
  }
}

TEST(Simulate, HalvesOfAMoveRemoveWhatTheMoveDoes) {
  const Part part;
  Program whole, halves;
  whole.steps = {{{-2.0, 8.0}, {1.0, 9.0}, 3.0, true}};
  halves.steps = {{{-2.0, 8.0}, {-0.5, 8.5}, 1.5, true}, {{-0.5, 8.5}, {1.0, 9.0}, 1.5, true}};
  const HeightMap a = simulate(whole, part.map, part.kernel, 1), b = simulate(halves, part.map, part.kernel, 1);
  for (const Index i : finite_pixels(part.map)) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_LE(std::abs(a.values[k] - b.values[k]), 1e-11);
  }
}

TEST(Simulate, ProgramThatOnlyTravelsRemovesNothing) {
  const Part part;
  Program program;
  program.steps = {{{-2.0, 8.0}, {1.0, 9.0}, 3.0, false}};
  const HeightMap removal = simulate(program, part.map, part.kernel, 1);
  for (const Index i : finite_pixels(part.map)) EXPECT_EQ(removal.values[static_cast<std::size_t>(i)], 0.0);
}

TEST(SurfaceAfter, SubtractsTheRemovalAndKeepsWhatIsMissing) {
  const Grid grid{1, 3, 1.0, 1.0, {}};
  const double none = std::nan("");
  const HeightMap after = surface_after(HeightMap(grid, {5.0, none, 7.0}), HeightMap(grid, {2.0, none, 10.0}));
  EXPECT_EQ(after.values[0], 3.0);
  EXPECT_TRUE(std::isnan(after.values[1]));
  EXPECT_EQ(after.values[2], -3.0);
}

}  // namespace
}  // namespace dwell
