#include "solvers/matched/resolution_matched_hessian.h"

namespace dwell {

ResolutionMatchedHessian::ResolutionMatchedHessian(const DwellProblem& problem, CoarseFactor factor)
    : problem_(problem),
      strokes_(dwell_lattice(*problem.geometry, factor).lattice, problem.geometry->strokes, StrokePart::Whole,
               problem.geometry->threads),
      removal_(problem, strokes_.lattice(), factor) {}

void ResolutionMatchedHessian::product(const Vector& d, Vector& hd) {
  strokes_.spread(d, density_);
  removal_.normal(density_, correlated_);
  strokes_.gather(correlated_, hd);
  if (problem_.alpha > 0.0 && !problem_.smoothness.empty()) problem_.smoothness.add_normal(problem_.alpha, d, hd);
  if (problem_.beta > 0.0) hd += problem_.beta * d;
}

void ResolutionMatchedHessian::gradient(const Vector& r, const Vector& t, Vector& g) {
  removal_.adjoint(r, correlated_);
  strokes_.gather(correlated_, g);
  add_penalty_gradient(problem_, t, g);
}

}  // namespace dwell
