#include "solvers/native/bounded_lbfgs.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

/// A matrix written out.
struct DenseForm final : QuadraticForm {
  explicit DenseForm(Eigen::MatrixXd matrix) : h(std::move(matrix)) {}
  void product(const Vector& d, Vector& hd) override { hd = h * d; }
  Eigen::MatrixXd h;
};

/// diag(1 .. condition), logarithmically, with neighbours coupled.
struct ChainForm final : QuadraticForm {
  ChainForm(Index n, double condition) : diagonal(n) {
    for (Index j = 0; j < n; ++j)
      diagonal[j] = std::pow(condition, static_cast<double>(j) / static_cast<double>(std::max<Index>(1, n - 1)));
  }
  void product(const Vector& d, Vector& hd) override {
    hd = diagonal.cwiseProduct(d);
    for (Index j = 1; j < d.size(); ++j) {
      hd[j] += 0.3 * d[j - 1];
      hd[j - 1] += 0.3 * d[j];
    }
  }
  Vector diagonal;
};

Vector noise(Index n, unsigned seed) {
  std::mt19937 random(seed);
  return Vector::NullaryExpr(
      n, [&] { return 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0; });
}

QuadraticPoint at(QuadraticForm& form, const Vector& x, const Vector& c) {
  QuadraticPoint p;
  p.x = x;
  form.product(x, p.gradient);
  p.value = 0.5 * x.dot(p.gradient) + c.dot(x);
  p.gradient += c;
  return p;
}

TEST(BoundedLbfgs, FindsTheMinimiserOfSmallProblems) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const test::SmallProblem small = test::random_problem({.points = 30, .upper = seed % 2 == 0}, seed);
    const test::Quadratic q = small.quadratic();
    const DwellProblem& p = small.problem;
    DenseForm form(q.h);
    QuadraticPoint point = at(form, p.lower, q.c);
    BoundedLbfgs lbfgs(p.lower, p.upper, 1);
    double last = point.value;
    long products = 0;
    lbfgs.minimise(form, 1e-10 * q.c.norm(), point, [&](const QuadraticPoint& now) {
      EXPECT_LE(now.value, last);
      EXPECT_TRUE((now.x.array() >= p.lower.array()).all());
      last = now.value;
      return ++products < 100'000;
    });
    EXPECT_LE(projected_gradient_norm(p.lower, p.upper, point), 1e-10 * q.c.norm());
    EXPECT_LE((q.gradient(point.x) - point.gradient).norm(), 1e-9 * q.c.norm());
    EXPECT_NEAR(point.value + q.constant, q.value(point.x), 1e-9 * std::abs(q.value(p.lower)));
    EXPECT_LE(q.value(point.x), q.value(test::minimise_by_coordinates(small)) + 1e-9 * std::abs(q.constant));
  }
}

// The pairs are held in single precision; the answer is not.
TEST(BoundedLbfgs, ReachesDoublePrecisionWithPairsInSingle) {
  ChainForm form(50, 1e4);
  const Vector c = noise(50, 1), lower = Vector::Constant(50, -0.2), none;
  QuadraticPoint point = at(form, Vector::Zero(50), c);
  BoundedLbfgs lbfgs(lower, none, 1);
  long products = 0;
  lbfgs.minimise(form, 1e-12, point, [&](const QuadraticPoint&) { return ++products < 20'000; });
  EXPECT_LE(projected_gradient_norm(lower, none, at(form, point.x, c)), 1e-9);
}

TEST(BoundedLbfgs, EveryLengthEndsRight) {
  for (Index n : {1, 2, 7, 8, 9, 15, 16, 17, 31, 1023, 1024, 1025, 2050}) {
    SCOPED_TRACE(n);
    ChainForm form(n, 10.0);
    const Vector c = noise(n, 3), lower = Vector::Constant(n, 0.05), upper = Vector::Constant(n, 0.4);
    QuadraticPoint point = at(form, lower, c);
    BoundedLbfgs lbfgs(lower, upper, 1);
    long products = 0;
    lbfgs.minimise(form, 1e-10, point, [&](const QuadraticPoint&) { return ++products < 5000; });
    EXPECT_LE(projected_gradient_norm(lower, upper, at(form, point.x, c)), 1e-9);
    EXPECT_TRUE((point.x.array() >= 0.05).all() && (point.x.array() <= 0.4).all());
  }
}

TEST(BoundedLbfgs, ThreadsDoNotChangeABit) {
  const Index n = 40'000;
  ChainForm form(n, 1e4);
  const Vector c = noise(n, 5), lower = Vector::Zero(n), none;
  std::array<Vector, 2> x;
  for (int threads : {1, 2}) {
    QuadraticPoint point = at(form, lower, c);
    BoundedLbfgs lbfgs(lower, none, threads);
    long products = 0;
    lbfgs.minimise(form, 1e-9, point, [&](const QuadraticPoint&) { return ++products < 60; });
    x[static_cast<std::size_t>(threads - 1)] = point.x;
  }
  EXPECT_TRUE(x[0] == x[1]);
}

// No curvature at all: only a bound ends the way down, and without one the run ends by itself.
TEST(BoundedLbfgs, FollowsAStraightLineToItsBound) {
  DenseForm form(Eigen::MatrixXd::Zero(3, 3));
  const Vector c = Eigen::Vector3d(1.0, -2.0, 0.0), lower = Vector::Zero(3), upper = Vector::Constant(3, 5.0);
  QuadraticPoint point = at(form, Vector::Ones(3), c);
  BoundedLbfgs lbfgs(lower, upper, 1);
  long products = 0;
  lbfgs.minimise(form, 1e-12, point, [&](const QuadraticPoint&) { return ++products < 1000; });
  EXPECT_TRUE(point.x == Vector(Eigen::Vector3d(0.0, 5.0, 1.0)));
}

TEST(BoundedLbfgs, GivesUpOnAProductThatIsNotFinite) {
  DenseForm form(Eigen::MatrixXd::Identity(3, 3));
  const Vector c = Eigen::Vector3d(1.0, -2.0, 3.0), lower = Vector::Zero(3), none;
  QuadraticPoint point = at(form, Vector::Ones(3), c);
  form.h(1, 1) = std::numeric_limits<double>::quiet_NaN();
  BoundedLbfgs lbfgs(lower, none, 1);
  long calls = 0;
  lbfgs.minimise(form, 1e-12, point, [&](const QuadraticPoint&) { return ++calls < 100; });
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(point.x == Vector::Ones(3));
}

TEST(BoundedLbfgs, PairsServeTheNextCall) {
  ChainForm form(400, 1e5);
  const Vector lower = Vector::Zero(400), none;
  std::array<long, 2> products{};  // of the second calls: pairs kept, pairs forgotten
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Vector c = noise(400, 20 + seed), next = c + 1e-3 * noise(400, 40 + seed);
    for (const bool forget : {false, true}) {
      QuadraticPoint point = at(form, lower, c);
      BoundedLbfgs lbfgs(lower, none, 1);
      lbfgs.minimise(form, 1e-4, point, [](const QuadraticPoint&) { return true; });
      if (forget) lbfgs.forget();
      point = at(form, point.x, next);
      // As far as pairs of another gradient can lead: later on there are only new ones.
      const double enough = 0.3 * projected_gradient_norm(lower, none, point);
      lbfgs.minimise(form, enough, point,
                     [&](const QuadraticPoint&) { return ++products[static_cast<std::size_t>(forget)] < 100'000; });
      EXPECT_LE(projected_gradient_norm(lower, none, point), enough);
    }
  }
  EXPECT_LT(products[0], products[1]);
}

}  // namespace
}  // namespace dwell
