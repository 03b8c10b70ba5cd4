#pragma once

#include <random>

#include "core/form/form.h"
#include "core/removal/removal_geometry.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell {

enum class Special { None, ZeroTarget, NegativeTarget, OnePoint, OnePixel, Repeated };

/// A small dwell problem with its operator: a part with a missing corner, a Gaussian tool, points anywhere, bounds of
/// both kinds. Seeds differ in size, terms and which bounds hold. `Repeated` has every dwell point twice, so that A is
/// rank-deficient and the minimiser not unique (its objective is).
struct RandomProblem {
  std::shared_ptr<RemovalGeometry> geometry = std::make_shared<RemovalGeometry>();
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;

  RandomProblem(unsigned seed, Special special) {
    std::mt19937 random(seed);
    const auto uniform = [&](double a, double b) {
      return a + (b - a) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    RemovalGeometry& g = *geometry;
    g.lattice = {10 + static_cast<Index>(random() % 6), 12 + static_cast<Index>(random() % 6), 0.5, 0.5, {-3.0, 2.0}};
    for (Index i = 0; i < g.lattice.size(); ++i) {
      if (i / g.lattice.cols + i % g.lattice.cols > 3) g.pixels.push_back(i);
    }
    if (special == Special::OnePixel) g.pixels = {g.lattice.size() / 2};
    // Wide enough that the automatic solver has something to coarsen.
    g.kernel = removal_kernel(gaussian_removal(uniform(0.5, 2.0), uniform(2.5, 4.0), 4.0), 0.5, 0.5);
    ToolPath path;
    const int n = special == Special::OnePoint ? 1 : 5 + static_cast<int>(random() % 20);
    for (int j = 0; j < n; ++j) {
      const Point q{uniform(g.lattice.origin.x - 1.0, g.lattice.origin.x + g.lattice.width()),
                    uniform(g.lattice.origin.y - 1.0, g.lattice.origin.y + g.lattice.height())};
      for (int k = 0; k < (special == Special::Repeated ? 2 : 1); ++k) path.points.push_back(q);
    }
    path.lifted.assign(path.points.size(), 0);
    g.strokes = halting_strokes(path);
    removal = make_removal_operator(g);
    fill(uniform, path, special);
  }

 private:
  template <typename Uniform>
  void fill(const Uniform& uniform, const ToolPath& path, Special special) {
    DwellProblem& p = problem;
    p.removal = removal.get();
    const Index m = removal->rows(), n = removal->cols();
    p.target = Vector::NullaryExpr(m, [&] { return uniform(0.0, 20.0); });
    if (special == Special::ZeroTarget) p.target.setZero();
    if (special == Special::NegativeTarget) p.target = -p.target;
    if (uniform(0.0, 1.0) < 0.5) p.weights = Vector::NullaryExpr(m, [&] { return uniform(0.2, 1.5); });
    if (m > 10 && uniform(0.0, 1.0) < 0.5) {
      const std::vector<double> w(p.weights.data(), p.weights.data() + p.weights.size());
      p.form = form_basis(geometry->lattice, geometry->pixels, {true, true, false}, w);
    }
    p.parts = {{geometry, path_smoothness(path, geometry->strokes)}};
    p.alpha = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(0.0, 0.2) * geometry->kernel.energy;
    p.beta = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(0.0, 0.05) * geometry->kernel.energy;
    p.gamma = uniform(0.0, 1.0) < 0.5 ? 0.0 : uniform(0.0, 5.0);
    if (p.beta > 0.0) p.reference = Vector::NullaryExpr(n, [&] { return uniform(0.0, 2.0); });
    p.lower = Vector::NullaryExpr(n, [&] { return uniform(0.0, 0.4); });
    if (uniform(0.0, 1.0) < 0.7) p.upper = p.lower + Vector::NullaryExpr(n, [&] { return uniform(0.0, 1.0); });
  }
};

}  // namespace dwell
