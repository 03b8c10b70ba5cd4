// Problems of an expected residual: every solver against a dense minimiser that knows the removal and its changes by
// formulas alone, and `auto` on coarse pixels against the full problem.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/tif/kernel_change.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/expected_removal.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/matched/rastered_part.h"

namespace dwell {
namespace {

constexpr double kRate = 0.1, kWidth = 0.15, kShift = 0.3;  // standard deviations; the last in mm

/// A rastered part whose tool is uncertain in rate, width and place.
struct UncertainPart {
  test::RasteredPart part;
  double fwhm, rate;
  std::vector<std::unique_ptr<RemovalOperator>> changed;
  std::unique_ptr<ExpectedRemoval> rows;
  DwellProblem plain, problem;

  explicit UncertainPart(const test::RasteredPart::Recipe& recipe)
      : part(recipe), fwhm(recipe.fwhm), rate(recipe.rate), plain(part.problem) {
    plain.gamma = 0.05 * static_cast<double>(plain.pixels()) * 1e-3;
    problem = plain;
    const RemovalFunction tif = gaussian_removal(rate, fwhm, 1.5 * fwhm);
    const RemovalKernel& kernel = part.geometry->kernel;
    std::vector<ExpectedRemoval::Block> blocks{{part.removal.get(), 1.0}, {part.removal.get(), kRate}};
    problem.parts.front().changes = {{part.geometry, kRate}};
    const auto add = [&](RemovalKernel change, double deviation) {
      auto geometry = std::make_shared<RemovalGeometry>(*part.geometry);
      geometry->kernel = std::move(change);
      changed.push_back(make_removal_operator(*geometry));
      problem.parts.front().changes.push_back({geometry, deviation});
      blocks.push_back({changed.back().get(), deviation});
    };
    add(kernel_by_width(tif, kernel, 0.2, 0.25), kWidth);
    add(kernel_by_shift(kernel, ShiftAxis::X), kShift);
    add(kernel_by_shift(kernel, ShiftAxis::Y), kShift);
    rows = std::make_unique<ExpectedRemoval>(std::move(blocks));
    problem.removal = rows.get();
    problem.target.setZero(plain.target.size() * problem.blocks());
    problem.target.head(plain.target.size()) = plain.target;
    problem.beta = 0.002 * kernel.energy;
  }

  /// The rows of the removal (0) or of its changes, by formulas: rate, width, shift in x, shift in y.
  Eigen::MatrixXd matrix(int block) const {
    const RemovalGeometry& g = *part.geometry;
    const double sigma = fwhm / std::sqrt(8.0 * std::log(2.0));
    Eigen::MatrixXd a(static_cast<Index>(g.pixels.size()), static_cast<Index>(g.strokes.size()));
    for (Index i = 0; i < a.rows(); ++i) {
      for (Index j = 0; j < a.cols(); ++j) {
        const Point d =
            g.lattice.centre(g.pixels[static_cast<std::size_t>(i)]) - g.strokes[static_cast<std::size_t>(j)].via;
        const double q = dot(d, d) / (sigma * sigma), b = rate * std::exp(-0.5 * q);
        a(i, j) = block == 0   ? b
                  : block == 1 ? kRate * b
                  : block == 2 ? kWidth * b * (q - 2.0)
                               : -kShift * b * (block == 3 ? d.x : d.y) / (sigma * sigma);
      }
    }
    return a;
  }
};

/// The expected objective as 1/2 t'H t + c't + constant.
struct DenseExpectation {
  Eigen::MatrixXd h;
  Vector c;
  double constant = 0.0;

  explicit DenseExpectation(const UncertainPart& u) {
    const DwellProblem& p = u.problem;
    const Index n = p.points();
    h = p.alpha * p.parts[0].smoothness.dense_normal() + p.beta * Eigen::MatrixXd::Identity(n, n);
    const auto without_form = [&](const Eigen::MatrixXd& rows) -> Eigen::MatrixXd {
      return rows - p.form * (p.form.transpose() * rows);
    };
    for (int block = 0; block < 5; ++block) {
      const Eigen::MatrixXd a = without_form(u.matrix(block));
      h += a.transpose() * a;
      if (block > 0) continue;
      const Vector z = without_form(u.plain.target);
      c = Vector::Constant(n, p.gamma) - a.transpose() * z;
      constant = 0.5 * z.squaredNorm();
    }
  }

  double value(const Vector& t) const { return 0.5 * t.dot(h * t) + c.dot(t) + constant; }

  /// By coordinate descent, from zero.
  Vector minimise() const {
    Vector t = Vector::Zero(c.size()), g = c;
    for (int sweep = 0; sweep < 20'000; ++sweep) {
      double largest = 0.0;
      for (Index j = 0; j < t.size(); ++j) {
        const double change = std::max(0.0, t[j] - g[j] / h(j, j)) - t[j];
        g += change * h.col(j);
        t[j] += change;
        largest = std::max(largest, std::abs(change));
      }
      if (largest < 1e-10) break;
    }
    return t;
  }
};

const UncertainPart& uncertain_part() {
  static const UncertainPart kPart({.step = 9});
  return kPart;
}
const DenseExpectation& dense_expectation() {
  static const DenseExpectation kDense(uncertain_part());
  return kDense;
}

TEST(ExpectedRows, AreWhatFormulasSay) {
  const UncertainPart& u = uncertain_part();
  DwellObjective objective(u.problem);
  Vector t(u.problem.points()), r, g;
  for (Index j = 0; j < t.size(); ++j) t[j] = 1.0 + std::sin(0.7 * static_cast<double>(j));
  const double value = objective.evaluate(t, r, g), expected = dense_expectation().value(t);
  EXPECT_NEAR(value, expected, 2e-3 * expected);  // kernels are splines, and the tool has a rim
  const Vector gradient = dense_expectation().h * t + dense_expectation().c;
  EXPECT_LE((g - gradient).norm(), 2e-3 * gradient.norm());
  for (int block = 1; block < 5; ++block) {
    const Index m = u.plain.target.size();
    Vector of_block = u.matrix(block) * t;
    of_block -= u.problem.form * (u.problem.form.transpose() * of_block);
    EXPECT_LE((r.segment(block * m, m) - of_block).norm(), 0.04 * of_block.norm())
        << block;  // the width's by a difference
  }
}

TEST(ExpectedRows, EverySolverFindsTheDenseOptimum) {
  const UncertainPart& u = uncertain_part();
  const DenseExpectation& dense = dense_expectation();
  const double optimum = dense.value(dense.minimise());
  Vector of_plain;
  SolverOptions options;
  options.kind = SolverKind::ProjectedLbfgs;
  options.gradient_tolerance = 1e-7, options.objective_tolerance = 0.0;
  make_solver(options)->solve(u.plain, of_plain);
  EXPECT_GT(dense.value(of_plain), 1.05 * optimum) << "the plain optimum is another";
  for (const SolverRecord& solver : solver_catalogue()) {
    if (solver.kind == SolverKind::Fourier) continue;
    options.kind = solver.kind;
    options.max_iterations = 600;
    Vector t;
    const SolverSummary summary = make_solver(options)->solve(u.problem, t);
    EXPECT_NEAR(dense.value(t), optimum, 5e-3 * optimum) << solver.name << ": " << summary.message;
    const Certificate certificate = certify(u.problem, t);
    EXPECT_NEAR(certificate.objective, dense.value(t), 3e-3 * optimum) << solver.name;
    EXPECT_GT(certificate.lower_bound, 0.5 * optimum) << solver.name;
    EXPECT_LE(certificate.lower_bound, certificate.objective) << solver.name;
  }
  options.kind = SolverKind::Fourier;
  Vector t;
  EXPECT_THROW(make_solver(options)->solve(u.problem, t), InputError);
}

TEST(ExpectedRows, AutoKnowsThemOnItsCoarsePixels) {
  const UncertainPart u({.step = 1});
  SolverOptions options;
  Vector by_auto, of_plain, exact;
  const SolverSummary plain = make_solver(options)->solve(u.plain, of_plain);
  const SolverSummary robust = make_solver(options)->solve(u.problem, by_auto);
  EXPECT_GT(robust.coarse_pairs, 0.0) << robust.message;
  EXPECT_LE(robust.operator_applications, 2 * plain.operator_applications + 4);
  options.kind = SolverKind::ProjectedLbfgs;
  options.gradient_tolerance = 1e-6, options.objective_tolerance = 0.0;
  options.max_iterations = 3000;
  const SolverSummary full = make_solver(options)->solve(u.problem, exact);
  EXPECT_LE(robust.objective, 1.01 * full.objective) << robust.message << "; " << full.message;
}

TEST(ExpectedRows, AreValidated) {
  const UncertainPart& u = uncertain_part();
  DwellProblem wrong = u.problem;
  wrong.parts.front().changes.pop_back();
  EXPECT_THROW(validate(wrong), std::invalid_argument);
  wrong = u.problem;
  wrong.parts.front().changes.back().factor = -1.0;
  EXPECT_THROW(validate(wrong), std::invalid_argument);
  wrong = u.problem;
  wrong.parts.front().changes.back().geometry.reset();
  EXPECT_THROW(validate(wrong), std::invalid_argument);
  EXPECT_THROW(ExpectedRemoval({}), std::invalid_argument);
  EXPECT_THROW(ExpectedRemoval({{u.part.removal.get(), 0.5}}), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
