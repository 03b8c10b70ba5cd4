// Problems of two tools on one part: every solver against the dense one, and `auto` against a solver that knows nothing
// of parts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/errors.h"
#include "core/form/form.h"
#include "solvers/matched/smooth_dwell.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

struct Tool {
  double fwhm = 0.0, step = 0.0;  // [mm]
  bool columns = false;           // whether its lines run along y
};

/// A round part, to be worked on with several Gaussian tools, each along lines of its own.
struct ToolsProblem {
  std::vector<std::shared_ptr<const RemovalGeometry>> geometries;
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;

  ToolsProblem(Grid map, const std::vector<Tool>& tools) {
    std::vector<Index> pixels;
    const Point middle = map.centre(map.rows / 2, map.cols / 2);
    for (Index i = 0; i < map.size(); ++i) {
      if (distance(map.centre(i), middle) <= 0.5 * map.width()) pixels.push_back(i);
    }
    for (const Tool& tool : tools) {
      RemovalGeometry g{map,
                        pixels,
                        removal_kernel(gaussian_removal(2.0, tool.fwhm, 1.5 * tool.fwhm), map.pitch_x, map.pitch_y),
                        {},
                        1};
      const ToolPath path = lines(map, tool);
      g.strokes = moving_strokes(path);
      problem.parts.push_back({nullptr, path_smoothness(path, g.strokes), 0.01 * g.kernel.energy});
      geometries.push_back(std::make_shared<const RemovalGeometry>(std::move(g)));
      problem.parts.back().geometry = geometries.back();
      problem.parts.back().price = problem.parts.size() == 1 ? 1.0 : 1.5;
    }
    removal = make_removal_operator(geometries);
    problem.removal = removal.get();
    problem.target = Vector(removal->rows());
    std::mt19937 random(3);
    for (Index i = 0; i < problem.target.size(); ++i) {
      const Point p = map.centre(pixels[static_cast<std::size_t>(i)]) - middle;
      problem.target[i] = 30.0 + 20.0 * std::sin(0.35 * p.x) * std::cos(0.3 * p.y) + 6.0 * std::sin(1.4 * p.x + p.y) +
                          static_cast<double>(random() % 1000) / 1000.0;
    }
    problem.form = form_basis(map, pixels, {true, true, false}, {});
    problem.gamma = 0.5;
    problem.lower = Vector::Constant(removal->cols(), 0.002);
  }

 private:
  static ToolPath lines(const Grid& map, const Tool& tool) {
    ToolPath path;
    const double beyond = 0.3 * tool.fwhm, across = 0.5 * map.width() + beyond;
    const Point middle = map.centre(map.rows / 2, map.cols / 2);
    bool back = false;
    for (double v = -across; v <= across; v += tool.step, back = !back) {
      for (double u = -across; u <= across; u += tool.step) {
        const double along = back ? -u : u;
        path.points.push_back(middle + (tool.columns ? Point{v, along} : Point{along, v}));
      }
    }
    path.lifted.assign(path.points.size(), 0);
    return path;
  }
};

ToolsProblem small_tools() { return ToolsProblem({45, 45, 0.2, 0.2, {}}, {{6.0, 1.7, false}, {2.0, 1.3, true}}); }

SolverOptions precise(SolverKind kind) {
  SolverOptions options;
  options.kind = kind;
  options.gradient_tolerance = 1e-6;
  options.objective_tolerance = 0.0;
  options.max_iterations = solver_record(kind).peer ? 3000 : 100'000;
  return options;
}

/// By the dense solver, which takes half a second.
const Vector& optimum_of_small_tools() {
  static const Vector kOptimum = [] {
    Vector t;
    make_solver(precise(SolverKind::DenseNnls))->solve(small_tools().problem, t);
    return t;
  }();
  return kOptimum;
}

class EverySolverOnTwoTools : public testing::TestWithParam<SolverKind> {};

TEST_P(EverySolverOnTwoTools, FindsTheOptimumOfTheDenseSolver) {
  const ToolsProblem two = small_tools();
  const Vector& expected = optimum_of_small_tools();
  Vector t;
  ASSERT_TRUE(certify(two.problem, expected).passes(1e-6));
  // Both tools have work to do: leaving one out is dearer.
  const Index wide = two.problem.parts[0].points();
  ASSERT_GT(expected.head(wide).maxCoeff(), 0.01);
  ASSERT_GT(expected.tail(expected.size() - wide).maxCoeff(), 0.01);

  const SolverSummary summary = make_solver(precise(GetParam()))->solve(two.problem, t);
  ASSERT_TRUE(summary.usable()) << summary.message;
  const Certificate found = certify(two.problem, t), best = certify(two.problem, expected);
  EXPECT_LE(found.bound_violation, 0.0);
  // Ceres and NLopt end where they can do no better, or after the iterations that a test can wait for.
  const bool ours = !solver_record(GetParam()).peer;
  EXPECT_LE(found.objective, (1.0 + (ours ? 1e-6 : 1e-2)) * best.objective) << summary.message;
  EXPECT_GE(found.objective, (1.0 - 1e-6) * best.objective);
  if (!ours) return;
  EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  EXPECT_TRUE(found.passes(1.01e-6)) << found.projected_gradient;
}

std::vector<SolverKind> optimisers() {
  std::vector<SolverKind> kinds;
  for (const SolverRecord& solver : solver_catalogue()) {
    const bool large_enough = !solver.largest || *solver.largest >= 400;
    if (solver.kind != SolverKind::Fourier && large_enough) kinds.push_back(solver.kind);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EverySolverOnTwoTools, testing::ValuesIn(optimisers()), [](const auto& instance) {
  std::string name = to_string(instance.param);
  std::erase(name, '-');
  return name;
});

TEST(TwoTools, AreDecidedTogetherByAutoOnCoarsePixels) {
  const ToolsProblem two({36, 36, 0.3, 0.3, {}}, {{7.0, 0.35, false}, {4.5, 0.35, true}});
  // Dense enough for smooth dwell on coarse lattices, of both tools.
  ASSERT_TRUE(StackedSmoothDwell(two.problem, {3, 3}).has_points_for_each(3));
  Vector by_auto, by_cg;
  SolverOptions options = precise(SolverKind::Auto);
  options.gradient_tolerance = 1e-4;
  const SolverSummary summary = make_solver(options)->solve(two.problem, by_auto);
  EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  EXPECT_GT(summary.coarse_pairs, 0.0);
  EXPECT_TRUE(certify(two.problem, by_auto).passes(1.01e-4));
  options.kind = SolverKind::ProjectedCg;
  options.objective_tolerance = 1e-5;
  ASSERT_TRUE(make_solver(options)->solve(two.problem, by_cg).converged());
  const double best = certify(two.problem, by_cg).objective;
  EXPECT_NEAR(certify(two.problem, by_auto).objective, best, 5e-3 * best);
  // By the default rules, within what they promise.
  Vector quick;
  const SolverSummary settled = make_solver(SolverOptions{})->solve(two.problem, quick);
  EXPECT_TRUE(settled.converged()) << settled.message;
  EXPECT_LE(certify(two.problem, quick).objective, 1.02 * best) << settled.message;
}

TEST(TwoTools, OfWhichOneIsSplitAreTheSameProblem) {
  // Two passes of one tool over the same strokes do together what one pass does: only the sum of the dwell counts.
  const Grid map{30, 30, 0.5, 0.5, {}};
  const ToolsProblem once(map, {{4.0, 1.1, false}});
  const ToolsProblem twice(map, {{4.0, 1.1, false}, {4.0, 1.1, false}});
  const Index n = once.problem.points();
  ASSERT_EQ(twice.problem.points(), 2 * n);
  const Vector t = Vector::LinSpaced(n, 0.0, 1.0);
  Vector both(2 * n), of_once, of_twice;
  both << 0.25 * t, 0.75 * t;
  once.removal->apply(t, of_once);
  twice.removal->apply(both, of_twice);
  EXPECT_LE((of_once - of_twice).norm(), 1e-13 * of_once.norm());
  const double alpha = *once.problem.parts[0].alpha;
  const Vector& least = once.problem.lower;
  both << least + t, least + 2.0 * t;
  const double squares = alpha * once.problem.parts[0].smoothness.squared_norm(t);
  EXPECT_DOUBLE_EQ(squared_steps(once.problem, t), squares);
  EXPECT_NEAR(smoothness_term(once.problem, least + t), squares, 1e-12 * squares);
  EXPECT_NEAR(smoothness_term(twice.problem, both), 5.0 * squares, 1e-12 * squares);
  EXPECT_NEAR(step_rms(twice.problem, both), std::sqrt(2.5) * step_rms(once.problem, least + t), 1e-12);
}

TEST(TwoTools, AreRefusedWhereTheyDoNotFit) {
  const auto refused = [](const auto& change, const char* words) {
    ToolsProblem two = small_tools();
    change(two.problem);
    try {
      validate(two.problem);
      ADD_FAILURE() << words;
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(words));
    }
  };
  refused([](DwellProblem& p) { p.parts.pop_back(); }, "parts[0].geometry strokes");
  refused([](DwellProblem& p) { p.parts[1] = {}; }, "parts[1].geometry and smoothness are empty");
  refused([](DwellProblem& p) { p.parts[1].smoothness = PathSmoothness({1.0}, {0}); }, "parts[1].smoothness");
  refused([](DwellProblem& p) { p.parts[1].alpha = -1.0; }, "parts[1].alpha = -1");
  refused([](DwellProblem& p) { p.parts[1].price = 0.0; }, "parts[1].price = 0");
  refused([](DwellProblem& p) { p.parts.push_back(p.parts[0]); }, "parts together");
  refused(
      [](DwellProblem& p) {
        RemovalGeometry moved = *p.parts[1].geometry;
        moved.lattice.origin.x += 1.0;
        p.parts[1].geometry = std::make_shared<const RemovalGeometry>(moved);
      },
      "parts[1].geometry has another map");
  const ToolsProblem two = small_tools();
  Vector t;
  test::expect_input_error([&] { make_solver(precise(SolverKind::Fourier))->solve(two.problem, t); },
                           {"fourier", "2 tools"});
}

}  // namespace
}  // namespace dwell
