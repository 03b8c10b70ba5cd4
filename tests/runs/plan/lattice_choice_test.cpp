#include "runs/plan/lattice_choice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/removal/removal_once.h"
#include "core/removal/simulate.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/machine_program.h"
#include "runs/plan/program_prediction.h"

namespace dwell {
namespace {

/// A bowl on coarse pixels, lying off its middle.
HeightMap bowl(double pitch_x, double pitch_y) {
  HeightMap map(
      Grid{static_cast<Index>(40.0 / pitch_y), static_cast<Index>(44.0 / pitch_x), pitch_x, pitch_y, {-20.0, 7.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i) - Point{3.0, 25.0};
    map.values[static_cast<std::size_t>(i)] = 300.0 + 0.15 * (p.x * p.x + 0.7 * p.y * p.y);
  }
  return map;
}

LaidPath raster(const Part& part) {
  return lay_path(part, parse_path_spec("raster:pitch=2,step=1,overrun=4"), Motion::Moving, 50.0);
}

TEST(LatticeChoice, TakesTheMapsPixelsForASmoothTool) {
  const Part part = make_part(bowl(0.5, 0.5), gaussian_removal(10.0, 6.0, 10.0), {}, 2);
  const LatticeChoice choice = choose_lattice(part, raster(part).strokes, {});
  EXPECT_EQ(choice.kernel.division, PixelDivision{});
  EXPECT_LE(choice.error, kLatticeError);
  EXPECT_FALSE(choice.finest);
}

TEST(LatticeChoice, DividesThePixelsForASharpTool) {
  const Part part = make_part(bowl(2.0, 1.0), spinning_disc_removal(1.0, 4.2), {}, 2);
  const LatticeChoice choice = choose_lattice(part, raster(part).strokes, {});
  EXPECT_GT(choice.kernel.division.x, 1);
  EXPECT_GT(choice.kernel.division.x, choice.kernel.division.y);  // cells are about square
  EXPECT_LE(choice.error, kLatticeError);
  const LatticeChoice finer = finer_lattice(part, choice);
  EXPECT_EQ(finer.kernel.division.x, 2 * choice.kernel.division.x);
  LatticeChoice last = finer;
  while (!last.finest) last = finer_lattice(part, last);
  EXPECT_EQ(finer_lattice(part, last).kernel.division, last.kernel.division);
}

/// A million pixels of which no tool of 40 can tell its neighbours apart.
TEST(LatticeChoice, TakesOneNodeInManyPixelsForAToolMuchWiderThanOne) {
  const Part part = make_part(bowl(0.04, 0.03), gaussian_removal(10.0, 4.0, 8.0), {}, 2);
  const LaidPath laid = raster(part);
  const LatticeChoice choice = choose_lattice(part, laid.strokes, {});
  EXPECT_GE(choice.kernel.coarse.x, 6);
  EXPECT_GT(choice.kernel.coarse.y, choice.kernel.coarse.x);  // about square in mm
  EXPECT_LE(choice.error, 1e-4);
  EXPECT_EQ(lattice_words(choice.kernel),
            fmt::format("one node in {} x {} pixels", choice.kernel.coarse.x, choice.kernel.coarse.y));
  const LatticeChoice finer = finer_lattice(part, choice);
  EXPECT_LT(finer.kernel.coarse.x, choice.kernel.coarse.x);
  LatticeChoice last = finer;
  for (int k = 0; k < 8 && last.kernel.coarse != CoarseFactor{}; ++k) last = finer_lattice(part, last);
  EXPECT_EQ(last.kernel.coarse, CoarseFactor{});
  EXPECT_EQ(last.kernel.division, PixelDivision{});
  const Vector seconds = Vector::Constant(static_cast<Index>(laid.strokes.size()), 0.02);
  const std::vector<Index> pixels = finite_pixels(part.map);
  const Vector fine = removal_once(part.map.grid, pixels, part.kernel, laid.strokes, seconds, 2);
  const Vector coarse = removal_once(part.map.grid, pixels, choice.kernel, laid.strokes, seconds, 2);
  EXPECT_LT((coarse - fine).norm(), 1e-4 * fine.norm());
}

/// What the plan's program leaves, from the removal function at every pixel.
void expect_stated(const Part& part) {
  const LaidPath laid = raster(part);
  const DwellPlan plan = find_dwell(part, laid, {}, {}, ExactCheck::Figure);
  ASSERT_TRUE(plan.limits.empty()) << plan.limits.front();
  const MachineProgram program = make_machine_program(laid, plan, {});
  const ExactResidual exact =
      predict_program(part, program_of(program.table), plan.lattice.kernel, {}, ExactCheck::EveryPixel);
  EXPECT_NEAR(plan.exact.statistics.rms, exact.statistics.rms, 0.01 * exact.statistics.rms);
  EXPECT_NEAR(plan.residual.rms, exact.statistics.rms, 0.05 * exact.statistics.rms);
  EXPECT_LE(exact.lattice_error, 0.06 * exact.statistics.rms_about_zero());
  // On the map's own pixels, the same solve states less than it leaves.
  EXPECT_GT(plan.lattice.kernel.division.x, 1);
}

TEST(FindDwell, StatesWhatASharpToolLeaves) {
  expect_stated(make_part(bowl(2.0, 1.0), spinning_disc_removal(1.0, 4.2), {true, true}, 2));
}

// Three and a half pixels a FWHM: right to 0.2 % of the removal on the map's own pixels, but so little is left that it
// matters.
TEST(FindDwell, SolvesAgainWhereTheLatticesErrorIsMuchOfWhatIsLeft) {
  const Part part = make_part(bowl(1.0, 1.0), gaussian_removal(10.0, 3.5, 10.0), {true, true}, 2);
  EXPECT_EQ(choose_lattice(part, raster(part).strokes, {}).kernel.division, PixelDivision{});
  const DwellPlan plan = find_dwell(part, raster(part), {});
  EXPECT_GT(plan.lattices, 1);
  expect_stated(part);
}

}  // namespace
}  // namespace dwell
