#include "solvers/matched/smooth_dwell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dwell {
namespace {

Grid cover_of(const Grid& map, const DwellLattice& at, CoarseFactor factor) {
  // One coarse step inside the lattice on every side, where cubic splines are whole.
  Grid cover = map;
  cover.origin = map.centre((at.first_row + 1) * factor.y, (at.first_col + 1) * factor.x);
  cover.rows = (at.lattice.rows - 3) * factor.y + 1;
  cover.cols = (at.lattice.cols - 3) * factor.x + 1;
  return cover;
}

/// Adds sums over dwell points, given by pixel of the cover.
void add_sums(const Vector& by_pixel, SplineGram::Take take, double scale, SplineGram& gram) {
  if (!(scale > 0.0)) return;
  std::vector<Index> pixels;
  pixels.reserve(static_cast<std::size_t>((by_pixel.array() != 0.0).count()));
  for (Index i = 0; i < by_pixel.size(); ++i) {
    if (by_pixel[i] != 0.0) pixels.push_back(i);
  }
  gram.add(pixels, by_pixel(pixels), take, scale);
}

}  // namespace

SmoothDwell::SmoothDwell(const RemovalGeometry& g, CoarseFactor factor)
    : cover_(cover_of(g.map, dwell_lattice(g, factor), factor)),
      origin_(g.map.origin),
      points_(SplineGram::lattice_of(cover_, factor), g.strokes, StrokePart::Via, g.threads) {}

// Every node of the coarse lattice is one of this lattice's, so B-splines on it are sums of those here.
Vector SmoothDwell::refined(const SmoothDwell& coarse, const Vector& s) const {
  TwoScale relation(lattice(), origin_);
  const Grid &from = coarse.lattice(), &all = relation.coarse();
  const auto row = static_cast<Index>(std::llround((from.origin.y - all.origin.y) / all.pitch_y));
  const auto col = static_cast<Index>(std::llround((from.origin.x - all.origin.x) / all.pitch_x));
  Vector held = Vector::Zero(all.size()), result;
  for (Index i = 0; i < from.size(); ++i) {
    const Index r = row + i / from.cols, c = col + i % from.cols;
    if (r >= 0 && c >= 0 && r < all.rows && c < all.cols) held[all.index(r, c)] = s[i];
  }
  relation.prolong(held, result);
  return result;
}

Vector SmoothDwell::largest(const DwellProblem& problem) const {
  if (problem.upper.size() == 0) return {};
  Vector result = Vector::Constant(size(), std::numeric_limits<double>::infinity());
  for (Index j = 0; j < problem.points(); ++j) {
    const double room = problem.upper[j] - problem.lower[j];
    points_.for_nodes(j, [&](Index node) { result[node] = std::min(result[node], room); });
  }
  return result;
}

SmoothDwellHessian::SmoothDwellHessian(const DwellProblem& problem, const SmoothDwell& dwell, CoarseFactor factor)
    : points_(dwell.cover(), factor, problem.geometry->threads),
      penalty_(dwell.cover(), factor, problem.geometry->threads),
      to_removal_(dwell.lattice(), problem.geometry->map.origin),
      removal_(problem, to_removal_.coarse(), {2 * factor.x, 2 * factor.y}) {
  const std::vector<Stroke>& strokes = problem.geometry->strokes;
  const Grid& cover = dwell.cover();
  const auto pixel = [&](const Stroke& s) {
    // Strokes far off are at the edge, as they are for SplineSpreading.
    const auto nearest = [](double at, Index lines) {
      return static_cast<Index>(std::lround(std::clamp(at, 0.0, static_cast<double>(lines - 1))));
    };
    return cover.index(nearest((s.via.y - cover.origin.y) / cover.pitch_y, cover.rows),
                       nearest((s.via.x - cover.origin.x) / cover.pitch_x, cover.cols));
  };
  Vector sums = Vector::Zero(cover.size());
  for (const Stroke& s : strokes) sums[pixel(s)] += 1.0;
  add_sums(sums, SplineGram::Take::Value, 1.0, points_);
  add_sums(sums, SplineGram::Take::Value, problem.beta, penalty_);
  if (!(problem.alpha > 0.0) || problem.smoothness.empty()) return;
  for (const auto take : {SplineGram::Take::SlopeX, SplineGram::Take::SlopeY}) {
    sums.setZero();
    for (Index j = 1; j < problem.points(); ++j) {
      if (!problem.smoothness.linked(j)) continue;
      const Point step = strokes[static_cast<std::size_t>(j)].via - strokes[static_cast<std::size_t>(j) - 1].via;
      const double pixels = take == SplineGram::Take::SlopeX ? step.x / cover.pitch_x : step.y / cover.pitch_y;
      const double slope = problem.smoothness.scale(j) * pixels;
      sums[pixel(strokes[static_cast<std::size_t>(j)])] += slope * slope;
    }
    add_sums(sums, take, problem.alpha, penalty_);
  }
}

void SmoothDwellHessian::product(const Vector& d, Vector& hd) {
  points_.apply(d, density_);
  to_removal_.restrict_to(density_, coarse_);
  removal_.normal(coarse_, correlated_);
  to_removal_.prolong(correlated_, density_);
  points_.apply(density_, hd);
  penalty_.apply(d, part_);
  hd += part_;
}

void SmoothDwellHessian::removal_gradient(const Vector& r, Vector& g) {
  removal_.adjoint(r, correlated_);
  to_removal_.prolong(correlated_, density_);
  points_.apply(density_, g);
}

}  // namespace dwell
