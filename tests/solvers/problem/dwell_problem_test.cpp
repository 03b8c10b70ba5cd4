#include "solvers/problem/dwell_problem.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/numbers.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::kNaN;
using test::random_problem;
using test::SmallProblem;

/// Expects validate to refuse the changed problem in words that contain `field`.
void expect_refused(const std::function<void(DwellProblem&)>& change, const std::string& field) {
  SmallProblem small = random_problem({.points = 6}, 1);
  ASSERT_NO_THROW(validate(small.problem));
  change(small.problem);
  try {
    validate(small.problem);
    ADD_FAILURE() << "accepted a bad " << field;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("DwellProblem." + field), std::string::npos) << error.what();
  }
}

TEST(DwellProblem, NamesTheFieldWithAValueThatIsNotFinite) {
  for (double bad : {kNaN, kInfinity, -kInfinity}) {
    expect_refused([&](DwellProblem& p) { p.target[3] = bad; }, "target[3]");
    expect_refused([&](DwellProblem& p) { p.lower[2] = bad; }, "lower[2]");
    expect_refused([&](DwellProblem& p) { p.reference[5] = bad; }, "reference[5]");
    expect_refused([&](DwellProblem& p) { p.weights[199] = bad; }, "weights[199]");
    expect_refused([&](DwellProblem& p) { p.form(7, 1) = bad; }, "form");
    expect_refused([&](DwellProblem& p) { p.alpha = bad; }, "alpha");
    expect_refused([&](DwellProblem& p) { p.beta = bad; }, "beta");
    expect_refused([&](DwellProblem& p) { p.gamma = bad; }, "gamma");
  }
  for (double bad : {kNaN, -kInfinity}) expect_refused([&](DwellProblem& p) { p.upper[1] = bad; }, "lower[1]");
}

TEST(DwellProblem, NamesTheFieldThatIsOutOfRange) {
  expect_refused([](DwellProblem& p) { p.alpha = -1e-9; }, "alpha");
  expect_refused([](DwellProblem& p) { p.beta = -1e-9; }, "beta");
  expect_refused([](DwellProblem& p) { p.gamma = -1e-9; }, "gamma");
  expect_refused([](DwellProblem& p) { p.weights[4] = -1e-9; }, "weights[4]");
  expect_refused([](DwellProblem& p) { p.upper[0] = p.lower[0] - 1e-9; }, "lower[0]");
}

TEST(DwellProblem, NamesTheFieldOfTheWrongSize) {
  expect_refused([](DwellProblem& p) { p.removal = nullptr; }, "removal");
  expect_refused([](DwellProblem& p) { p.target = Vector::Zero(199); }, "target");
  expect_refused([](DwellProblem& p) { p.lower = Vector::Zero(7); }, "lower");
  expect_refused([](DwellProblem& p) { p.upper = Vector::Ones(5); }, "upper");
  expect_refused([](DwellProblem& p) { p.reference = Vector::Ones(7); }, "reference");
  expect_refused([](DwellProblem& p) { p.weights = Vector::Ones(6); }, "weights");
  expect_refused([](DwellProblem& p) { p.form = Eigen::MatrixXd::Zero(6, 3); }, "form");
  expect_refused([](DwellProblem& p) { p.form = Eigen::MatrixXd::Identity(200, kMaxFormTerms + 1); }, "form");
  expect_refused(
      [](DwellProblem& p) {
        p.parts[0].smoothness = PathSmoothness({1.0, 1.0}, {0, 1});
      },
      "parts[0].smoothness");
}

TEST(DwellProblem, TakesInfiniteAndMissingUpperBounds) {
  SmallProblem small = random_problem({.points = 6}, 1);
  small.problem.upper[0] = kInfinity;
  EXPECT_NO_THROW(validate(small.problem));
  EXPECT_EQ(small.problem.upper_at(0), kInfinity);
  small.problem.upper.resize(0);
  EXPECT_NO_THROW(validate(small.problem));
  EXPECT_EQ(small.problem.upper_at(5), kInfinity);
}

TEST(DwellProblem, ClipsIntoTheBounds) {
  SmallProblem small = random_problem({.points = 3}, 2);
  small.problem.lower << 0.1, 0.2, 0.3;
  small.problem.upper.resize(3);
  small.problem.upper << 1.0, 2.0, kInfinity;
  Vector t(3);
  t << -5.0, 5.0, 5.0;
  clip_to_bounds(small.problem, t);
  EXPECT_EQ(t, (Vector(3) << 0.1, 2.0, 5.0).finished());
  small.problem.upper.resize(0);
  t << 0.0, 1e9, 0.3;
  clip_to_bounds(small.problem, t);
  EXPECT_EQ(t, (Vector(3) << 0.1, 1e9, 0.3).finished());
}

TEST(DwellProblem, ProjectsTheGradientOntoWhatTheBoundsAllow) {
  SmallProblem small = random_problem({.points = 6}, 2);
  small.problem.lower = Vector::Zero(6);
  small.problem.upper = Vector::Ones(6);
  Vector t(6), g(6), projected;
  t << 0.0, 0.0, 1.0, 1.0, 0.5, 0.5;
  g << 1.0, -1.0, 1.0, -1.0, 1.0, -1.0;
  project_gradient(small.problem, t, g, projected);
  EXPECT_EQ(projected, (Vector(6) << 0.0, -1.0, 1.0, 0.0, 1.0, -1.0).finished());
}

// Value, gradient and curvature against the quadratic written out from the definition, for every mix of terms.
TEST(DwellObjective, IsTheQuadraticOfItsDefinition) {
  for (unsigned mix = 0; mix < 64; ++mix) {
    SCOPED_TRACE(mix);
    SmallProblem small = random_problem({.points = 9}, mix);
    DwellProblem& p = small.problem;
    if (mix & 1u) p.weights.resize(0);
    if (mix & 2u) p.form.resize(0, 0);
    if (mix & 4u) p.alpha = 0.0;
    if (mix & 8u) p.beta = 0.0;
    if (mix & 16u) p.gamma = 0.0;
    if (mix & 32u) p.reference.resize(0);
    // Form columns span W times the terms only with the weights they were made for; any orthonormal ones define P.
    const auto q = small.quadratic();
    DwellObjective objective(p);
    Vector r, g, image, h;
    const Vector t = Vector::LinSpaced(9, -0.3, 1.7), d = Vector::LinSpaced(9, 1.0, -2.0);
    objective.residual(t, r);
    const double size = q.constant + std::abs(q.c.dot(t)) + t.dot(q.h * t);
    EXPECT_NEAR(objective.value(r, t), q.value(t), 1e-13 * size);
    objective.gradient(r, t, g);
    EXPECT_LE((g - q.gradient(t)).norm(), 1e-12 * (q.c.norm() + q.h.norm() * t.norm()));
    objective.image(d, image);
    EXPECT_NEAR(objective.curvature(d, image), d.dot(q.h * d), 1e-12 * d.dot(q.h * d));
    objective.hessian_times(d, image, h);
    EXPECT_LE((h - q.h * d).norm(), 1e-12 * q.h.norm() * d.norm());
    EXPECT_NEAR(objective.gradient_scale(), test::gradient_scale(small), 1e-12 * test::gradient_scale(small));
  }
}

TEST(DwellObjective, StatesItsOperatorApplications) {
  const SmallProblem small = random_problem({.points = 9}, 3);
  DwellObjective objective(small.problem);
  Vector t = Vector::Ones(9), r, g, image, h;
  const auto applications = [&](auto call) {
    const long before = small.removal->applications();
    call();
    return small.removal->applications() - before;
  };
  EXPECT_EQ(applications([&] { objective.residual(t, r); }), 1);
  EXPECT_EQ(applications([&] { objective.gradient(r, t, g); }), 1);
  EXPECT_EQ(applications([&] { objective.image(t, image); }), 1);
  EXPECT_EQ(applications([&] { objective.hessian_times(t, image, h); }), 1);
  EXPECT_EQ(applications([&] { objective.curvature(t, image); }), 0);
  EXPECT_EQ(applications([&] { objective.value(r, t); }), 0);
  EXPECT_EQ(applications([&] { objective.gradient_scale(); }), 1);
  EXPECT_EQ(applications([&] { objective.gradient_scale(); }), 0);
}

TEST(DwellObjective, APixelOfWeightZeroCountsForNothing) {
  SmallProblem small = random_problem({.points = 9}, 4);
  const Vector t = Vector::LinSpaced(9, 0.0, 1.0);
  DwellObjective objective(small.problem);
  Vector r, g;
  objective.residual(t, r);
  objective.gradient(r, t, g);
  SmallProblem bent = random_problem({.points = 9}, 4);
  ASSERT_EQ(bent.problem.weights[7], 0.0);
  bent.problem.target[7] += 1e6;
  DwellObjective other(bent.problem);
  Vector r2, g2;
  other.residual(t, r2);
  other.gradient(r2, t, g2);
  EXPECT_EQ(other.value(r2, t), objective.value(r, t));
  EXPECT_EQ(g2, g);
}

}  // namespace
}  // namespace dwell
