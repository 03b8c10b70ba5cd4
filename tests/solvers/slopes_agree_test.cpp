// Problems whose objective has slopes and weights: every solver against a dense minimiser that shares no code with
// them, and `auto` on coarse pixels against the full problem.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/motion/tool_path.h"
#include "core/removal/removal_geometry.h"
#include "core/tif/removal_function.h"
#include "solvers/matched/resolution_matched_hessian.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/full_hessian.h"
#include "solvers/solver_catalogue.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

/// What a fit with slopes is made of.
struct SlopeRecipe {
  Grid map{24, 30, 0.2, 0.25, {-3.0, 5.0}};
  Index step = 4;  // of dwell points and lines [pixels]
  double fwhm = 2.4;
  bool heights = true;       // beside slopes
  PixelDivision division{};  // of the map's pixels
  double price = 0.4, smoothness = 0.01;
};

/// A part with a missing corner and a hole, its pixels weighted, under a Gaussian tool.
struct SlopeProblem {
  std::shared_ptr<RemovalGeometry> geometry;
  std::unique_ptr<RemovalOperator> heights, removal;
  std::vector<Index> pixels;  // of the map
  Grid map;
  DwellProblem problem;
  ToolPath path;

  explicit SlopeProblem(const SlopeRecipe& recipe) : map(recipe.map) {
    for (Index i = 0; i < map.size(); ++i) {
      const Index row = i / map.cols, col = i % map.cols;
      if (row + col > 8 && !(row > 12 && row < 16 && col == 9)) pixels.push_back(i);
    }
    for (Index r = -4, line = 0; r < map.rows + 4; r += recipe.step, ++line) {
      for (Index c = -4; c < map.cols + 4; c += recipe.step)
        path.points.push_back(map.centre(r, line % 2 == 0 ? c : map.cols - 1 - c));
    }
    path.lifted.assign(path.points.size(), 0);
    const RemovalFunction tif = gaussian_removal(2.0, recipe.fwhm, 1.5 * recipe.fwhm);
    geometry = std::make_shared<RemovalGeometry>(removal_geometry(
        map, pixels, pixel_kernel(tif, map.pitch_x, map.pitch_y, recipe.division), halting_strokes(path), 1));
    heights = make_removal_operator(*geometry);
    set_objective(recipe.heights);
    problem.parts = {{geometry, path_smoothness(path, geometry->strokes)}};
    problem.alpha = recipe.smoothness * geometry->kernel.energy;
    problem.gamma = recipe.price;
    problem.lower = Vector::Constant(heights->cols(), 0.001);
  }

  /// Heights that no tool makes whole.
  Vector surface() const {
    Vector z(static_cast<Index>(pixels.size()));
    for (Index i = 0; i < z.size(); ++i) {
      const Index pixel = pixels[static_cast<std::size_t>(i)];
      const Point q = map.centre(pixel);
      z[i] = 40.0 * std::sin(0.6 * q.x) * std::cos(0.5 * q.y) + 3.0 * std::sin(4.1 * q.y + 1.5 * q.x) +
             std::sin(static_cast<double>(11 * pixel % 17));
    }
    return z;
  }

 private:
  void set_objective(bool with_heights) {
    auto rows = std::make_shared<SurfaceRows>(map, pixels, with_heights);
    removal = std::make_unique<RowsOfRemoval>(*heights, *rows);
    problem.removal = removal.get();
    problem.rows = rows;
    rows->apply(surface(), problem.target);
    problem.weights = Vector::NullaryExpr(
        rows->rows(), [](Index i) { return 0.4 + 0.3 * std::abs(std::sin(static_cast<double>(i / 5))); });
    Eigen::MatrixXd terms(rows->rows(), with_heights ? 3 : 2);  // a piston has no slope
    Vector row;
    for (Index k = 0; k < terms.cols(); ++k) {
      Vector term(rows->pixels());
      for (Index i = 0; i < term.size(); ++i) {
        const Point q = map.centre(pixels[static_cast<std::size_t>(i)]);
        term[i] = k == 0 ? q.x : k == 1 ? q.y : 1.0;
      }
      rows->apply(term, row);
      terms.col(k) = row.cwiseProduct(problem.weights);
    }
    problem.form = oracle::thin_qr(terms).q;
  }
};

/// The objective as 1/2 t'H t + c't + constant, from the columns of the removal of heights and a loop over neighbours
/// alone; form terms are unknowns of their own, taken out by their normal equations.
struct DenseSlopes {
  Eigen::MatrixXd h;
  Vector c;
  double constant = 0.0;

  explicit DenseSlopes(const SlopeProblem& s) {
    const DwellProblem& p = s.problem;
    const Index n = p.points(), m = p.pixels();
    Eigen::MatrixXd columns(m, n + 4);  // A, z, and what form terms are
    Vector column;
    for (Index j = 0; j < n; ++j) {
      s.heights->apply(Vector::Unit(n, j), column);
      columns.col(j) = column;
    }
    columns.col(n) = s.surface();
    for (Index i = 0; i < m; ++i) {
      const Point q = s.map.centre(s.pixels[static_cast<std::size_t>(i)]);
      columns.row(i).tail(3) << 1.0, q.x, q.y;
    }
    const Eigen::MatrixXd w = weighted_rows(s, columns);
    const bool piston = p.rows->heights() > 0;
    const Eigen::MatrixXd form = w.rightCols(piston ? 3 : 2), rest = w.leftCols(n + 1);
    const Eigen::MatrixXd fitted = rest - form * oracle::least_squares_by_qr(form, rest);
    const Eigen::MatrixXd a = fitted.leftCols(n);
    const Vector z = fitted.col(n);
    h = a.transpose() * a + p.alpha * p.parts[0].smoothness.dense_normal();
    c = -a.transpose() * z - p.alpha * p.parts[0].smoothness.dense_normal() * p.lower + Vector::Constant(n, p.gamma);
    constant = 0.5 * z.squaredNorm() + 0.5 * p.alpha * p.lower.dot(p.parts[0].smoothness.dense_normal() * p.lower);
  }

  double value(const Vector& t) const { return 0.5 * t.dot(h * t) + c.dot(t) + constant; }

  /// By coordinate descent.
  Vector minimise(const Vector& lower) const {
    Vector t = lower, g = h * t + c;
    for (int sweep = 0; sweep < 100'000; ++sweep) {
      double largest = 0.0;
      for (Index j = 0; j < t.size(); ++j) {
        const double change = std::max(lower[j], t[j] - g[j] / h(j, j)) - t[j];
        g += change * h.col(j);
        t[j] += change;
        largest = std::max(largest, std::abs(change));
      }
      if (largest < 1e-13) break;
    }
    return t;
  }

 private:
  static Eigen::MatrixXd weighted_rows(const SlopeProblem& s, const Eigen::MatrixXd& columns) {
    const DwellProblem& p = s.problem;
    Eigen::MatrixXd rows(p.residuals(), columns.cols());
    Index k = 0;
    if (p.rows->heights() > 0) {
      rows.topRows(columns.rows()) = columns;
      k = columns.rows();
    }
    for (const bool along_x : {true, false}) {
      for (std::size_t i = 0; i < s.pixels.size(); ++i) {
        for (std::size_t j = 0; j < s.pixels.size(); ++j) {
          const Index row = s.pixels[i] / s.map.cols, col = s.pixels[i] % s.map.cols;
          const Index to_row = along_x ? row : row + 1, to_col = along_x ? col + 1 : col;
          if (to_col >= s.map.cols || s.pixels[j] != to_row * s.map.cols + to_col) continue;
          rows.row(k++) = (columns.row(static_cast<Index>(j)) - columns.row(static_cast<Index>(i))) /
                          (along_x ? s.map.pitch_x : s.map.pitch_y);
        }
      }
    }
    EXPECT_EQ(k, p.residuals());
    return p.weights.asDiagonal() * rows;
  }
};

/// A problem and its dense optimum.
struct SolvedSlopes {
  SlopeProblem slopes;
  DenseSlopes dense;
  Vector optimum;

  explicit SolvedSlopes(const SlopeRecipe& recipe)
      : slopes(recipe), dense(slopes), optimum(dense.minimise(slopes.problem.lower)) {}
};

const SolvedSlopes& solved_slopes(bool heights) {
  static const SolvedSlopes kBoth(SlopeRecipe{}), kSlopes(SlopeRecipe{.heights = false});
  return heights ? kBoth : kSlopes;
}

SolverOptions strict_options(SolverKind kind) {
  SolverOptions options;
  options.kind = kind;
  options.gradient_tolerance = 1e-7;
  options.objective_tolerance = 0.0;
  options.max_iterations = solver_record(kind).peer ? 3000 : 100'000;
  return options;
}

TEST(SlopeObjective, IsWhatADenseMatrixSays) {
  for (const bool heights : {true, false}) {
    const SolvedSlopes& s = solved_slopes(heights);
    DwellObjective objective(s.slopes.problem);
    Vector t = s.slopes.problem.lower, r, g;
    for (Index j = 0; j < t.size(); ++j) t[j] += 0.3 * std::abs(std::sin(static_cast<double>(3 * j)));
    const double value = objective.evaluate(t, r, g);
    EXPECT_NEAR(value, s.dense.value(t), 1e-10 * value);
    EXPECT_LE((g - (s.dense.h * t + s.dense.c)).norm(), 1e-10 * g.norm());
    EXPECT_GT((s.optimum.array() > 0.002).count(), 10);  // dwell to be found,
    EXPECT_GT((s.optimum.array() <= 0.001).count(), 3);  // and bounds that hold
  }
}

class EverySolverOnSlopes : public testing::TestWithParam<SolverKind> {};

TEST_P(EverySolverOnSlopes, FindsTheDenseOptimum) {
  for (const bool heights : {true, false}) {
    SCOPED_TRACE(heights);
    const SolvedSlopes& s = solved_slopes(heights);
    const DwellProblem& p = s.slopes.problem;
    Vector t;
    if (GetParam() == SolverKind::Fourier) {
      EXPECT_THROW(make_solver(strict_options(GetParam()))->solve(p, t), InputError);
      continue;
    }
    const SolverSummary summary = make_solver(strict_options(GetParam()))->solve(p, t);
    ASSERT_TRUE(summary.usable()) << summary.message;
    const double best = s.dense.value(s.optimum), found = s.dense.value(t);
    const bool ours = !solver_record(GetParam()).peer;
    EXPECT_LE(found, (1.0 + (ours ? 1e-6 : 1e-2)) * best) << summary.message;
    EXPECT_GE(found, (1.0 - 1e-9) * best);
    const Certificate certificate = certify(p, t);
    EXPECT_NEAR(certificate.objective, found, 1e-9 * found);
    EXPECT_LE(certificate.lower_bound, best * (1.0 + 1e-9));
  }
}

std::vector<SolverKind> all_solvers() {
  std::vector<SolverKind> kinds;
  for (const SolverRecord& record : solver_catalogue()) kinds.push_back(record.kind);
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(All, EverySolverOnSlopes, testing::ValuesIn(all_solvers()), [](const auto& instance) {
  std::string name = to_string(instance.param);
  std::erase(name, '-');
  return name;
});

/// Larger, so that `auto` has coarse pixels to work on, and a lattice for smooth dwell.
SlopeRecipe large_recipe(bool heights, PixelDivision division = {}) {
  SlopeRecipe recipe;
  recipe.map = {48, 66, 0.2, 0.25, {-3.0, 5.0}};
  recipe.step = 1;
  recipe.fwhm = division.x > 1 ? 1.2 : 3.0;
  recipe.heights = heights;
  recipe.division = division;
  return recipe;
}

TEST(SlopeObjective, HasItsHessianOnCoarsePixels) {
  for (const bool heights : {true, false}) {
    const SlopeProblem slopes(large_recipe(heights));
    ResolutionMatchedHessian matched(slopes.problem, matched_factor(slopes.geometry->kernel, 0.003));
    DwellObjective objective(slopes.problem);
    FullHessian full(objective);
    Vector expected, actual;
    const Vector d = Vector::NullaryExpr(slopes.problem.points(),
                                         [](Index j) { return std::sin(0.7 * static_cast<double>(j * j % 101)); });
    full.product(d, expected);
    matched.product(d, actual);
    EXPECT_LE((actual - expected).norm(), 0.02 * expected.norm());
  }
}

/// On a lattice that divides the pixels the model's curvature is the true one or a little more.
TEST(SlopeObjective, IsNeverFlatterOnPixelsThatAreDivided) {
  SlopeProblem slopes(large_recipe(false, {3, 3}));
  slopes.problem.alpha = 0.0;
  ASSERT_EQ(slopes.geometry->lattice.cols, 3 * (slopes.map.cols - 1) + 1);
  ResolutionMatchedHessian matched(slopes.problem, {4, 4});
  DwellObjective objective(slopes.problem);
  FullHessian full(objective);
  Vector expected, actual;
  for (int seed = 1; seed < 5; ++seed) {
    const Vector d = Vector::NullaryExpr(slopes.problem.points(), [seed](Index j) {
      return std::sin(0.01 * static_cast<double>(seed * j)) + std::sin(static_cast<double>(seed * j * j % 101));
    });
    full.product(d, expected);
    matched.product(d, actual);
    EXPECT_GT(d.dot(actual), 0.99 * d.dot(expected));
    EXPECT_LT(d.dot(actual), 1.25 * d.dot(expected));
  }
}

TEST(SlopeObjective, IsSettledByAutoWithinOnePerCent) {
  for (const auto& [heights, division] :
       {std::pair(true, PixelDivision{}), std::pair(false, PixelDivision{}), std::pair(false, PixelDivision{3, 3})}) {
    SCOPED_TRACE(testing::Message() << heights << division.x);
    const SlopeProblem slopes(large_recipe(heights, division));
    SolverOptions options;
    options.kind = SolverKind::Auto;
    Vector t, best;
    const SolverSummary summary = make_solver(options)->solve(slopes.problem, t);
    EXPECT_TRUE(summary.converged()) << summary.message;
    EXPECT_EQ(summary.message.find("projected-lbfgs"), std::string::npos) << summary.message;
    SolverOptions exact = strict_options(SolverKind::ProjectedLbfgs);
    exact.gradient_tolerance = 1e-5;
    ASSERT_TRUE(make_solver(exact)->solve(slopes.problem, best).converged());
    const double optimum = certify(slopes.problem, best).objective;
    EXPECT_LE(certify(slopes.problem, t).objective, 1.01 * optimum) << summary.message;
    EXPECT_LE(summary.iterations, 30) << summary.message;
  }
}

}  // namespace
}  // namespace dwell
