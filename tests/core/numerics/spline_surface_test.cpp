#include "core/numerics/spline_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/numerics/bspline.h"
#include "tests/core/removal/direct_removal.h"

namespace dwell {
namespace {

const Grid kGrid{7, 9, 0.5, 0.4, {-3.25, 7.1}};

std::vector<double> random_values(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(static_cast<std::size_t>(kGrid.size()));
  for (double& v : values) v = normal(random);
  return values;
}

TEST(BsplineWeights, AreTheFourSplinesThatDoNotVanish) {
  for (double f : {0.0, 0.1, 0.5, 0.77, 1.0 - 1e-16}) {
    const auto w = bspline_weights(f);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(w[static_cast<std::size_t>(k)], oracle::b3(f + 1.0 - k), 1e-15) << f << " " << k;
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1.0, 1e-15);
  }
}

TEST(SplineSurface, TakesItsSamplesAndZeroOnTheRing) {
  const auto values = random_values(1);
  const SplineSurface s(kGrid, values);
  constexpr Index kRing = SplineSurface::kMargin;
  for (Index r = -kRing; r < kGrid.rows + kRing; ++r) {
    for (Index c = -kRing; c < kGrid.cols + kRing; ++c) {
      const bool inside = r >= 0 && r < kGrid.rows && c >= 0 && c < kGrid.cols;
      const double expected = inside ? values[static_cast<std::size_t>(kGrid.index(r, c))] : 0.0;
      EXPECT_NEAR(s(kGrid.centre(r, c)), expected, 1e-12);
    }
  }
  EXPECT_EQ(s.grid().rows, kGrid.rows + 2 * kRing);
  EXPECT_EQ(s.grid().cols, kGrid.cols + 2 * kRing);
  EXPECT_EQ(static_cast<Index>(s.coefficients().size()), s.grid().size());
}

TEST(SplineSurface, AgreesWithTheSplineOfDenseAlgebraBetweenSamples) {
  const auto values = random_values(2);
  const SplineSurface s(kGrid, values);
  Eigen::MatrixXd samples(kGrid.rows, kGrid.cols);
  for (Index i = 0; i < kGrid.size(); ++i)
    samples(i / kGrid.cols, i % kGrid.cols) = values[static_cast<std::size_t>(i)];
  const oracle::DirectKernel direct(samples, kGrid.pitch_x, kGrid.pitch_y);
  const Point middle = kGrid.centre(kGrid.rows / 2, kGrid.cols / 2);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> x(-5.0, 5.0), y(-4.0, 4.0);
  for (int k = 0; k < 500; ++k) {
    const Point d{x(random), y(random)};
    EXPECT_NEAR(s(middle + d), direct.rate(d.x, d.y), 1e-12);
  }
}

// Third differences of a C2 function shrink with the step even across knots; a kink or jump in s, s' or s'' would not.
TEST(SplineSurface, IsTwiceContinuouslyDifferentiableAcrossKnots) {
  const SplineSurface s(kGrid, random_values(4));
  constexpr double kStep = 1e-3;
  for (Index c = -4; c < kGrid.cols + 4; ++c) {
    const Point p = kGrid.centre(3, c) + Point{0.0, 0.17};
    const auto second = [&](double at) {
      return (s(p + Point{at + kStep, 0}) - 2.0 * s(p + Point{at, 0}) + s(p + Point{at - kStep, 0})) / (kStep * kStep);
    };
    EXPECT_NEAR(s(p - Point{1e-9, 0}), s(p + Point{1e-9, 0}), 1e-7);
    EXPECT_NEAR(second(-kStep), second(kStep), 1.0);  // |s'''| 2 kStep < 4 * 6 / 0.5^3 * 2e-3
  }
}

TEST(SplineSurface, IsZeroBeyondTheRing) {
  const SplineSurface s(kGrid, std::vector<double>(static_cast<std::size_t>(kGrid.size()), 1.0));
  const Grid& g = s.grid();
  for (const Point p :
       {Point{g.x(-2) - 1e-9, g.y(5)}, Point{g.x(g.cols + 1) + 1e-9, g.y(5)}, Point{g.x(5), g.y(-2) - 1e-9},
        Point{g.x(5), g.y(g.rows + 1) + 1e-9}, Point{1e300, 0}, Point{-1e300, 1e300}, Point{NAN, 0}})
    EXPECT_EQ(s(p), 0.0);
  EXPECT_NE(s({g.x(-1), g.y(8)}), 0.0) << "the outermost spline reaches two samples out";
}

TEST(SplineSurface, TakesASingleSample) {
  const SplineSurface s(Grid{1, 1, 2.0, 3.0, {5.0, 6.0}}, {7.0});
  EXPECT_NEAR(s({5.0, 6.0}), 7.0, 1e-13);
  EXPECT_NEAR(s({7.0, 6.0}), 0.0, 1e-13);
  EXPECT_NEAR(s({6.1, 6.0}), s({3.9, 6.0}), 1e-13);
}

}  // namespace
}  // namespace dwell
