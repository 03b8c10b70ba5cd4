#pragma once

#include <cmath>
#include <memory>

#include "core/form/form.h"
#include "core/motion/tool_path.h"
#include "core/removal/removal_geometry.h"
#include "core/tif/removal_function.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell::test {

/// A part cut off at a corner and a raster over it.
struct RasteredPart {
  std::shared_ptr<RemovalGeometry> geometry = std::make_shared<RemovalGeometry>();
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;

  struct Recipe {
    Index step = 1;        // of dwell points and lines, in pixels
    double fwhm = 3.0;     // of the tool, in mm; a pixel is 0.2 by 0.25 mm
    double rate = 2.0;     // of the tool, nm/s
    double height = 40.0;  // nm
    double ripple = 1.0;   // nm, which no tool reaches
  };

  explicit RasteredPart(const Recipe& recipe) {
    RemovalGeometry& g = *geometry;
    g.lattice = {48, 60, 0.2, 0.25, {-3.0, 5.0}};
    for (Index i = 0; i < g.lattice.size(); ++i) {
      if (i / g.lattice.cols + i % g.lattice.cols > 20) g.pixels.push_back(i);
    }
    g.kernel = removal_kernel(gaussian_removal(recipe.rate, recipe.fwhm, 1.5 * recipe.fwhm), 0.2, 0.25);
    ToolPath path;
    for (Index r = -6; r < 54; r += recipe.step) {
      for (Index k = -6; k < 66; k += recipe.step) {
        path.points.push_back(g.lattice.centre(r, (r / recipe.step) % 2 == 0 ? k : 60 - k));
      }
    }
    path.lifted.assign(path.points.size(), 0);
    g.strokes = halting_strokes(path);
    removal = make_removal_operator(g);
    DwellProblem& p = problem;
    p.removal = removal.get();
    p.target.resize(removal->rows());
    for (Index i = 0; i < p.target.size(); ++i) {
      const Index pixel = g.pixels[static_cast<std::size_t>(i)];
      const Point q = g.lattice.centre(pixel);
      p.target[i] =
          recipe.height * (std::sin(0.6 * q.x) * std::cos(0.5 * q.y) + 0.1 * std::sin(1.1 * q.y + 0.5 * q.x)) +
          recipe.ripple * ((pixel / g.lattice.cols + pixel % g.lattice.cols) % 2 == 0 ? 1.0 : -1.0);
    }
    p.form = form_basis(g.lattice, g.pixels, {true, true, false}, {});
    p.parts = {{geometry, path_smoothness(path, g.strokes)}};
    p.alpha = 0.01 * g.kernel.energy;
    p.lower = Vector::Zero(removal->cols());
  }
};

}  // namespace dwell::test
