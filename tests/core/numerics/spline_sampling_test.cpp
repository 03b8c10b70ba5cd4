#include "core/numerics/spline_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace dwell {
namespace {

/// B3 written out from its definition.
double cubic(double u) {
  const double a = std::abs(u);
  if (a >= 2.0) return 0.0;
  return a >= 1.0 ? std::pow(2.0 - a, 3) / 6.0 : 2.0 / 3.0 - a * a + 0.5 * a * a * a;
}

double sampled(const Grid& lattice, const Eigen::VectorXd& nodes, Point p) {
  double sum = 0.0;
  for (Index k = 0; k < lattice.size(); ++k) {
    const Point node = lattice.centre(k);
    sum += nodes[k] * cubic((p.x - node.x) / lattice.pitch_x) * cubic((p.y - node.y) / lattice.pitch_y);
  }
  return sum;
}

const Grid kMap{23, 31, 0.2, 0.3, {-4.0, 7.0}};

std::vector<Index> ragged(const Grid& map) {
  std::vector<Index> pixels;
  for (Index i = 0; i < map.size(); ++i)
    if ((i / map.cols + 2 * (i % map.cols)) % 7 != 0 && i / map.cols != 5) pixels.push_back(i);
  return pixels;
}

Eigen::VectorXd waves(Index n, double step) {
  Eigen::VectorXd v(n);
  for (Index k = 0; k < n; ++k) v[k] = std::sin(step * static_cast<double>(k)) + 0.3;
  return v;
}

TEST(SplineSampling, IsTheSumOfBSplinesAtEveryPixel) {
  for (const CoarseFactor factor : {CoarseFactor{4, 3}, CoarseFactor{1, 1}, CoarseFactor{40, 5}}) {
    SplineSampling sampling(kMap, factor, 2);
    const std::vector<Index> pixels = ragged(kMap);
    const Eigen::VectorXd nodes = waves(sampling.lattice().size(), 0.7);
    Eigen::VectorXd values;
    sampling.sample(nodes, pixels, values);
    ASSERT_EQ(values.size(), static_cast<Index>(pixels.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
      EXPECT_NEAR(values[static_cast<Index>(i)], sampled(sampling.lattice(), nodes, kMap.centre(pixels[i])), 1e-13);
  }
}

/// Also with so many pixels that threads share them.
TEST(SplineSampling, SpreadsAsTheTransposeOfSampling) {
  for (const Grid& map : {kMap, Grid{300, 401, 0.1, 0.2, {1.0, 2.0}}}) {
    for (const int threads : {1, 2, 3}) {
      SplineSampling sampling(map, {4, 3}, threads);
      const std::vector<Index> pixels = ragged(map);
      const Eigen::VectorXd nodes = waves(sampling.lattice().size(), 0.7),
                            values = waves(static_cast<Index>(pixels.size()), 1.1);
      Eigen::VectorXd at_pixels, at_nodes;
      sampling.sample(nodes, pixels, at_pixels);
      sampling.spread(pixels, values, at_nodes);
      EXPECT_NEAR(at_pixels.dot(values), at_nodes.dot(nodes), 1e-10 * std::abs(at_nodes.dot(nodes)) + 1e-9);
    }
  }
}

TEST(SplineSampling, RefusesWrongSizes) {
  SplineSampling sampling(kMap, {4, 3}, 1);
  Eigen::VectorXd out;
  EXPECT_THROW(sampling.sample(Eigen::VectorXd::Zero(3), {0, 1}, out), std::invalid_argument);
  EXPECT_THROW(sampling.spread({0, 1}, Eigen::VectorXd::Zero(3), out), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
