#include "solvers/problem/path_smoothness.h"

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

// More points than a stretch holds, so that links cross from one to the next; the sums here go link by link.
TEST(PathSmoothness, AgreesWithALoopOverLinksOnManyPointsForAnyNumberOfThreads) {
  constexpr Index kPoints = 40'000;
  std::vector<double> lengths;
  std::vector<char> joined;
  Vector t(kPoints), start(kPoints);
  for (Index j = 0; j < kPoints; ++j) {
    lengths.push_back(0.5 + 0.1 * static_cast<double>(j % 7));
    joined.push_back(j % 911 != 0);
    t[j] = std::sin(0.37 * static_cast<double>(j * j % 1013));
    start[j] = 0.01 * static_cast<double>(j % 13);
  }
  const PathSmoothness one(lengths, joined);
  Vector expected = start;
  double squares = 0.0;
  for (Index j = 1; j < kPoints; ++j) {
    if (!joined[static_cast<std::size_t>(j)]) continue;
    const double step = one.scale(j) * t[j] - one.scale(j - 1) * t[j - 1];
    squares += step * step;
    expected[j] += 0.3 * one.scale(j) * step;
    expected[j - 1] -= 0.3 * one.scale(j - 1) * step;
  }
  Vector normal = start;
  one.add_normal(0.3, t, normal);
  EXPECT_LE((normal - expected).norm(), 1e-14 * expected.norm());
  EXPECT_NEAR(one.squared_norm(t), squares, 1e-12 * squares);
  for (const int threads : {2, 3}) {
    const PathSmoothness many(lengths, joined, threads);
    Vector other = start;
    many.add_normal(0.3, t, other);
    EXPECT_EQ(other, normal);
    EXPECT_EQ(many.squared_norm(t), one.squared_norm(t));
  }
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
