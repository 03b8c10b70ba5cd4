#include "core/removal/coarse_removal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/removal/removal_geometry.h"
#include "core/removal/removal_once.h"
#include "core/tif/removal_function.h"

namespace dwell {
namespace {

/// A ragged part of pixels that are not square, a tool some 8 pixels wide, and strokes that turn and jump.
struct WideTool {
  Grid map{60, 90, 0.2, 0.25, {-3.0, 5.0}};
  std::vector<Index> pixels;
  RemovalKernel kernel = removal_kernel(gaussian_removal(2.0, 5.0, 11.0), 0.2, 0.25);
  std::vector<Stroke> strokes;
  Vector seconds;

  WideTool() {
    for (Index i = 0; i < map.size(); ++i)
      if (i / map.cols + i % map.cols > 20) pixels.push_back(i);
    for (int k = 0; k < 400; ++k) {
      const double at = 0.05 * static_cast<double>(k);
      const Point a{-6.0 + 1.2 * at, 2.0 + 9.0 * std::fmod(at, 2.0)}, b{a.x + 0.7, a.y + 0.9};
      strokes.push_back({a, midpoint(a, b), b});
    }
    seconds.resize(400);
    for (Index k = 0; k < 400; ++k) seconds[k] = 1.0 + 0.8 * std::sin(0.05 * static_cast<double>(k));
  }

  RemovalKernel coarse(Index x, Index y) const {
    RemovalKernel k = kernel;
    k.coarse = {x, y};
    return k;
  }
};

TEST(CoarseRemoval, RemovesWhatTheFineOperatorDoesToFourthOrder) {
  const WideTool tool;
  ScatteredRemoval fine(tool.map, tool.pixels, tool.kernel, tool.strokes, 1);
  Vector expected, removal;
  fine.apply(tool.seconds, expected);
  double before = 0.0;
  for (const Index factor : {2, 4}) {
    CoarseRemoval coarse(tool.map, tool.pixels, tool.coarse(factor, factor), tool.strokes, 2);
    coarse.apply(tool.seconds, removal);
    const double error = (removal - expected).norm() / expected.norm();
    EXPECT_LT(error, factor == 2 ? 1e-5 : 2e-4);
    EXPECT_GT(error, 6.0 * before) << "as the fourth power of the pitch, or nearly so";
    before = error;
  }
}

TEST(CoarseRemoval, HasItsTransposeForAdjoint) {
  const WideTool tool;
  CoarseRemoval coarse(tool.map, tool.pixels, tool.coarse(3, 2), tool.strokes, 2);
  Vector removal, back, residual(coarse.rows());
  for (Index i = 0; i < residual.size(); ++i) residual[i] = std::cos(0.37 * static_cast<double>(i));
  coarse.apply(tool.seconds, removal);
  coarse.apply_adjoint(residual, back);
  EXPECT_NEAR(removal.dot(residual), back.dot(tool.seconds), 1e-10 * removal.norm() * residual.norm());
}

TEST(CoarseRemoval, IsWhatTheGeometryMakesAndRemovalOnceGives) {
  const WideTool tool;
  const RemovalKernel kernel = tool.coarse(3, 3);
  const auto removal = make_removal_operator(removal_geometry(tool.map, tool.pixels, kernel, tool.strokes, 1));
  EXPECT_EQ(removal->name(), "coarse");
  Vector applied;
  removal->apply(tool.seconds, applied);
  const Vector once = removal_once(tool.map, tool.pixels, kernel, tool.strokes, tool.seconds, 1);
  EXPECT_LT((applied - once).norm(), 1e-12 * applied.norm());
}

/// Where constant dwell covers all that the tool reaches, the removal is the volume rate however coarse the lattice.
TEST(CoarseRemoval, KeepsTheVolumeOfAToolThatEndsWithAJump) {
  const RemovalKernel fine = removal_kernel(gaussian_removal(2.0, 5.0, 4.1), 0.2, 0.25);
  RemovalKernel kernel = fine;
  kernel.coarse = {4, 3};
  const auto volume = [](const RemovalKernel& k, double cell) {
    double sum = 0.0;
    for (const double c : k.surface.coefficients()) sum += c;
    return sum * cell;
  };
  EXPECT_NEAR(volume(coarse_kernel(kernel), 12.0), volume(fine, 1.0), 1e-12 * volume(fine, 1.0));
}

}  // namespace
}  // namespace dwell
