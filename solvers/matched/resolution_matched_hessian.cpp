#include "solvers/matched/resolution_matched_hessian.h"

namespace dwell {
namespace {

std::vector<SplineSpreading> spread_strokes(const DwellProblem& problem, CoarseFactor factor) {
  std::vector<SplineSpreading> strokes;
  strokes.reserve(problem.parts.size());
  for (const DwellPart& part : problem.parts) {
    const RemovalGeometry& g = *part.geometry;
    strokes.emplace_back(dwell_lattice(g, factor).lattice, g.strokes, StrokePart::Whole, g.threads);
  }
  return strokes;
}

std::vector<Grid> lattices_of(const std::vector<SplineSpreading>& strokes) {
  std::vector<Grid> lattices;
  lattices.reserve(strokes.size());
  for (const SplineSpreading& part : strokes) lattices.push_back(part.lattice());
  return lattices;
}

}  // namespace

ResolutionMatchedHessian::ResolutionMatchedHessian(const DwellProblem& problem, CoarseFactor factor)
    : problem_(problem),
      strokes_(spread_strokes(problem, factor)),
      removal_(problem, lattices_of(strokes_), factor),
      density_(strokes_.size()) {}

void ResolutionMatchedHessian::product(const Vector& d, Vector& hd) {
  Index first = 0;
  for (std::size_t k = 0; k < strokes_.size(); ++k) {
    strokes_[k].spread(d.segment(first, strokes_[k].strokes()), density_[k]);
    first += strokes_[k].strokes();
  }
  removal_.normal(density_, correlated_);
  gather(hd);
  add_smoothness(problem_, d, hd);
  if (problem_.beta > 0.0) hd += problem_.beta * d;
}

void ResolutionMatchedHessian::gradient(const Vector& r, const Vector& t, Vector& g) {
  removal_.adjoint(r, correlated_);
  gather(g);
  add_penalty_gradient(problem_, t, g);
}

/// What the coarse nodes of each part say of its dwell points.
void ResolutionMatchedHessian::gather(Vector& result) {
  result.resize(problem_.points());
  Index first = 0;
  for (std::size_t k = 0; k < strokes_.size(); ++k) {
    strokes_[k].gather(correlated_[k], result.segment(first, strokes_[k].strokes()));
    first += strokes_[k].strokes();
  }
}

}  // namespace dwell
