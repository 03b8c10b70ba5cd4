#include "core/motion/stroke_quadrature.h"

#include <gtest/gtest.h>

#include <random>

#include "core/numerics/spline_surface.h"

namespace dwell {
namespace {

const Grid kGrid{12, 15, 0.5, 0.4, {-3.25, 7.1}};

SplineSurface random_surface(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(static_cast<std::size_t>(kGrid.size()));
  for (double& v : values) v = normal(random);
  return {kGrid, values};
}

/// Midpoint rule along one straight piece.
double slow_integral(const SplineSurface& s, Point a, Point b, int steps = 40'000) {
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) sum += s(a + (k + 0.5) / steps * (b - a));
  return sum / steps * distance(a, b);
}

double weighted_sum(const SplineSurface& s, const std::vector<QuadraturePoint>& points) {
  double sum = 0.0;
  for (const auto& q : points) sum += q.weight * s(q.position);
  return sum;
}

TEST(StrokeQuadrature, AveragesASplineExactly) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> x(-4.0, 5.0), y(6.0, 12.5);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SplineSurface surface = random_surface(seed);
    const Stroke s{{x(random), y(random)}, {x(random), y(random)}, {x(random), y(random)}};
    std::vector<QuadraturePoint> points;
    append_stroke_quadrature(s, kGrid, points);
    double weights = 0.0;
    for (const auto& q : points) {
      EXPECT_GT(q.weight, 0.0);
      weights += q.weight;
    }
    EXPECT_NEAR(weights, 1.0, 1e-13);
    const double expected =
        (slow_integral(surface, s.start, s.via) + slow_integral(surface, s.via, s.finish)) / s.length();
    // The midpoint rule: L^2 / 24 steps^2 |f''| with |f''| <= 6 |c| (1/h)^2 ~ 100, L < 12: below 1e-6 / steps^2 share.
    EXPECT_NEAR(weighted_sum(surface, points), expected, 1e-6);
  }
}

// Against itself on a finer cut: an exact rule does not change when the stroke is cut anywhere.
TEST(StrokeQuadrature, DoesNotChangeWhenTheStrokeIsCut) {
  const SplineSurface surface = random_surface(4);
  const Point a{-2.9, 7.3}, b{2.7, 11.2};
  std::vector<QuadraturePoint> whole, first, second;
  append_stroke_quadrature({a, midpoint(a, b), b}, kGrid, whole);
  const Point cut = a + 0.317 * (b - a);
  append_stroke_quadrature({a, a, cut}, kGrid, first);
  append_stroke_quadrature({cut, b, b}, kGrid, second);
  EXPECT_NEAR(weighted_sum(surface, whole),
              0.317 * weighted_sum(surface, first) + 0.683 * weighted_sum(surface, second), 1e-14);
}

TEST(StrokeQuadrature, RunsAlongLatticeLines) {
  const SplineSurface surface = random_surface(5);
  for (const Point b : {kGrid.centre(3, 11), kGrid.centre(9, 2)}) {
    const Point a = kGrid.centre(3, 2);
    std::vector<QuadraturePoint> points;
    append_stroke_quadrature({a, midpoint(a, b), b}, kGrid, points);
    EXPECT_NEAR(weighted_sum(surface, points), slow_integral(surface, a, b) / distance(a, b), 1e-6);
  }
}

TEST(StrokeQuadrature, TakesAHaltAsOnePoint) {
  std::vector<QuadraturePoint> points(1, {{9, 9}, 9.0});
  append_stroke_quadrature({{1, 2}, {1, 2}, {1, 2}}, kGrid, points);
  ASSERT_EQ(points.size(), 2u) << "appends";
  EXPECT_EQ(points[0].weight, 9.0);
  EXPECT_EQ(points[1].position, (Point{1, 2}));
  EXPECT_EQ(points[1].weight, 1.0);
}

TEST(StrokeQuadrature, TakesAStrokeOfOneHalf) {
  const SplineSurface surface = random_surface(6);
  const Point a{-1.0, 8.0}, b{1.0, 9.0};
  for (const Stroke& s : {Stroke{a, a, b}, Stroke{a, b, b}}) {
    std::vector<QuadraturePoint> points;
    append_stroke_quadrature(s, kGrid, points);
    EXPECT_NEAR(weighted_sum(surface, points), slow_integral(surface, a, b) / distance(a, b), 1e-6);
  }
}

// A surface that is zero outside a box: what lies there adds nothing, and costs nothing however long it is.
TEST(StrokeQuadrature, LeavesOutWhatLiesBeyondTheReach) {
  const SplineSurface surface = random_surface(5);
  const Grid& g = surface.grid();  // of its coefficients; zero two pitches beyond
  const LatticeBox reach{(g.x(-2) - kGrid.origin.x) / kGrid.pitch_x, (g.x(g.cols + 1) - kGrid.origin.x) / kGrid.pitch_x,
                         (g.y(-2) - kGrid.origin.y) / kGrid.pitch_y,
                         (g.y(g.rows + 1) - kGrid.origin.y) / kGrid.pitch_y};
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> x(-9.0, 9.0), y(1.0, 18.0);
  for (int k = 0; k < 200; ++k) {
    const Stroke s{{x(random), y(random)}, {x(random), y(random)}, {x(random), y(random)}};
    std::vector<QuadraturePoint> all, near;
    append_stroke_quadrature(s, kGrid, all);
    append_stroke_quadrature(s, kGrid, reach, near);
    EXPECT_LE(near.size(), all.size() + 16);
    EXPECT_NEAR(weighted_sum(surface, near), weighted_sum(surface, all), 1e-13);
  }
  std::vector<QuadraturePoint> points;
  append_stroke_quadrature({{-1e9, 8.0}, {1.0, 8.0}, {1e12, 8.3}}, kGrid, reach, points);
  EXPECT_GT(points.size(), 10u);
  EXPECT_LT(points.size(), 500u);
  points.clear();
  append_stroke_quadrature({{-1e9, 80.0}, {1.0, 80.0}, {1e12, 80.0}}, kGrid, reach, points);
  append_stroke_quadrature({{50.0, 8.0}, {50.0, 8.0}, {50.0, 8.0}}, kGrid, reach, points);
  EXPECT_TRUE(points.empty());
}

}  // namespace
}  // namespace dwell
