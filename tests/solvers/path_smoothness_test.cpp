#include "solvers/path_smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dwell {
namespace {

Vector vector_of(std::initializer_list<double> values) {
  Vector v(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

TEST(PathSmoothness, SumsSquaredStepsBetweenNeighbours) {
  const PathSmoothness d({1.0, 1.0, 1.0}, {0, 1, 1});
  EXPECT_FALSE(d.empty());
  EXPECT_EQ(d.size(), 3);
  EXPECT_DOUBLE_EQ(d.squared_norm(vector_of({1.0, 3.0, 6.0})), 4.0 + 9.0);
  EXPECT_EQ(d.squared_norm(vector_of({2.0, 2.0, 2.0})), 0.0);
}

TEST(PathSmoothness, DoesNotLinkAcrossALift) {
  const PathSmoothness d({1.0, 1.0, 1.0, 1.0}, {0, 1, 0, 1});
  EXPECT_DOUBLE_EQ(d.squared_norm(vector_of({1.0, 1.0, 9.0, 9.0})), 0.0);
  EXPECT_DOUBLE_EQ(d.squared_norm(vector_of({1.0, 2.0, 9.0, 12.0})), 1.0 + 9.0);
}

TEST(PathSmoothness, IgnoresTheFlagOfTheFirstPoint) {
  EXPECT_DOUBLE_EQ(PathSmoothness({1.0, 1.0}, {1, 1}).squared_norm(vector_of({1.0, 3.0})), 4.0);
  EXPECT_DOUBLE_EQ(PathSmoothness({1.0, 1.0}, {0, 1}).squared_norm(vector_of({1.0, 3.0})), 4.0);
}

// Dwell in proportion to length is one feed throughout: nothing to smooth.
TEST(PathSmoothness, VanishesAtConstantFeed) {
  const PathSmoothness d({0.5, 1.0, 2.0, 0.25}, {0, 1, 1, 1});
  EXPECT_NEAR(d.squared_norm(3.0 * vector_of({0.5, 1.0, 2.0, 0.25})), 0.0, 1e-28);
  const double mean = 3.75 / 4.0;
  EXPECT_NEAR(d.squared_norm(vector_of({1.0, 0.0, 0.0, 0.0})), std::pow(mean / 0.5, 2), 1e-12);
  EXPECT_NEAR(d.squared_norm(vector_of({0.0, 0.0, 1.0, 0.0})), 2.0 * std::pow(mean / 2.0, 2), 1e-12);
}

TEST(PathSmoothness, TakesHaltsAsTheyAreAndKeepsTheScaleOfTinyStrokesBelow100) {
  const PathSmoothness d({1.0, 0.0, 1e-6, 2.0}, {0, 1, 0, 1});
  const double mean = (1.0 + 1e-6 + 2.0) / 3.0;
  EXPECT_NEAR(d.squared_norm(vector_of({0.0, 1.0, 0.0, 0.0})), 1.0, 1e-14);
  EXPECT_NEAR(d.squared_norm(vector_of({1.0, 0.0, 0.0, 0.0})), mean * mean, 1e-12);
  EXPECT_NEAR(d.squared_norm(vector_of({0.0, 0.0, 1.0, 0.0})), 1e4, 1e-8);
}

TEST(PathSmoothness, ItsNormalMatrixIsTheHessianOfItsNorm) {
  const PathSmoothness d({0.5, 1.0, 0.0, 0.25, 3.0, 1.0}, {0, 1, 1, 0, 1, 1});
  const Eigen::MatrixXd normal = d.dense_normal();
  const Vector t = vector_of({0.3, -1.0, 2.0, 0.7, 5.0, -0.1});
  EXPECT_NEAR(t.dot(normal * t), d.squared_norm(t), 1e-12 * d.squared_norm(t));
  EXPECT_EQ(normal, Eigen::MatrixXd(normal.transpose()));
  Vector out = Vector::Constant(6, 7.0);
  d.add_normal(2.0, t, out);
  EXPECT_LE((out - Vector::Constant(6, 7.0) - 2.0 * normal * t).norm(), 1e-12 * normal.norm() * t.norm());
}

TEST(PathSmoothness, FollowsThePath) {
  ToolPath path;
  path.points = {{0, 0}, {1, 0}, {3, 0}, {10, 0}, {11, 0}};
  path.lifted = {1, 0, 0, 1, 0};
  const auto strokes = moving_strokes(path);
  const PathSmoothness moving = path_smoothness(path, strokes);
  ASSERT_EQ(moving.size(), 5);
  Vector t(5);
  for (std::size_t j = 0; j < 5; ++j) t[static_cast<Index>(j)] = strokes[j].length();
  EXPECT_NEAR(moving.squared_norm(t), 0.0, 1e-28);
  t.tail(2) *= 2.0;  // another feed after the lift
  EXPECT_NEAR(moving.squared_norm(t), 0.0, 1e-28);
  EXPECT_DOUBLE_EQ(path_smoothness(path, halting_strokes(path)).squared_norm(vector_of({1, 2, 4, 100, 107})),
                   1.0 + 4.0 + 49.0);
}

TEST(PathSmoothness, IsEmptyUnlessMadeOfStrokes) {
  EXPECT_TRUE(PathSmoothness().empty());
  EXPECT_EQ(PathSmoothness({1.0}, {1}).squared_norm(Vector::Ones(1)), 0.0);
}

TEST(PathSmoothness, RefusesSizesThatDifferAndLengthsThatAreNone) {
  EXPECT_THROW(PathSmoothness({1.0, 1.0}, {0}), std::invalid_argument);
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0})
    EXPECT_THROW(PathSmoothness({1.0, bad}, {0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
