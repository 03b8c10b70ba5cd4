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
    : cover_(cover_of(g.lattice, dwell_lattice(g, factor), factor)),
      origin_(g.lattice.origin),
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

Vector SmoothDwell::largest(const Eigen::Ref<const Vector>& room) const {
  Vector result = Vector::Constant(size(), std::numeric_limits<double>::infinity());
  for (Index j = 0; j < points(); ++j)
    points_.for_nodes(j, [&](Index node) { result[node] = std::min(result[node], room[j]); });
  return result;
}

StackedSmoothDwell::StackedSmoothDwell(const DwellProblem& problem, CoarseFactor factor) {
  for (const DwellPart& part : problem.parts) {
    parts_.emplace_back(*part.geometry, factor);
    size_ += parts_.back().size();
  }
}

bool StackedSmoothDwell::has_points_for_each(Index points_per_coefficient) const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [&](const SmoothDwell& p) { return p.size() * points_per_coefficient <= p.points(); });
}

void StackedSmoothDwell::prolong(const Vector& s, Vector& t) const {
  Index node = 0, point = 0, points = 0;
  for (const SmoothDwell& p : parts_) points += p.points();
  t.resize(points);
  for (const SmoothDwell& p : parts_) {
    p.prolong(s.segment(node, p.size()), t.segment(point, p.points()));
    node += p.size();
    point += p.points();
  }
}

void StackedSmoothDwell::restrict_to(const Vector& g, Vector& coarse) {
  Index node = 0, point = 0;
  coarse.resize(size_);
  for (SmoothDwell& p : parts_) {
    p.restrict_to(g.segment(point, p.points()), part_);
    coarse.segment(node, p.size()) = part_;
    node += p.size();
    point += p.points();
  }
}

Vector StackedSmoothDwell::refined(const StackedSmoothDwell& coarse, const Vector& s) const {
  Vector result(size_);
  Index node = 0, from = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Index of_coarse = coarse.parts_[k].size();
    result.segment(node, parts_[k].size()) = parts_[k].refined(coarse.parts_[k], s.segment(from, of_coarse));
    node += parts_[k].size();
    from += of_coarse;
  }
  return result;
}

Vector StackedSmoothDwell::largest(const DwellProblem& problem) const {
  if (problem.upper.size() == 0) return {};
  const Vector room = problem.upper - problem.lower;
  Vector result(size_);
  Index node = 0, point = 0;
  for (const SmoothDwell& p : parts_) {
    result.segment(node, p.size()) = p.largest(room.segment(point, p.points()));
    node += p.size();
    point += p.points();
  }
  return result;
}

SmoothDwellHessian::SmoothDwellHessian(const DwellProblem& problem, const StackedSmoothDwell& dwell,
                                       CoarseFactor factor)
    : sums_(make_all_sums(problem, dwell, factor)),
      removal_(problem, removal_lattices(sums_), {2 * factor.x, 2 * factor.y}),
      coarse_(sums_.size()) {}

std::vector<SmoothDwellHessian::Sums> SmoothDwellHessian::make_all_sums(const DwellProblem& problem,
                                                                        const StackedSmoothDwell& dwell,
                                                                        CoarseFactor factor) {
  std::vector<Sums> all;
  for (std::size_t k = 0; k < problem.parts.size(); ++k)
    all.push_back(make_sums(problem, problem.parts[k], dwell.parts()[k], factor));
  return all;
}

std::vector<Grid> SmoothDwellHessian::removal_lattices(const std::vector<Sums>& sums) {
  std::vector<Grid> lattices;
  lattices.reserve(sums.size());
  for (const Sums& part : sums) lattices.push_back(part.to_removal.coarse());
  return lattices;
}

SmoothDwellHessian::Sums SmoothDwellHessian::make_sums(const DwellProblem& problem, const DwellPart& part,
                                                       const SmoothDwell& dwell, CoarseFactor factor) {
  const RemovalGeometry& g = *part.geometry;
  const Grid& cover = dwell.cover();
  Sums result{{cover, factor, g.threads}, {cover, factor, g.threads}, {dwell.lattice(), g.lattice.origin}, {}};
  const auto pixel = [&](const Stroke& s) {
    // Strokes far off are at the edge, as they are for SplineSpreading.
    const auto nearest = [](double at, Index lines) {
      return static_cast<Index>(std::lround(std::clamp(at, 0.0, static_cast<double>(lines - 1))));
    };
    return cover.index(nearest((s.via.y - cover.origin.y) / cover.pitch_y, cover.rows),
                       nearest((s.via.x - cover.origin.x) / cover.pitch_x, cover.cols));
  };
  Vector sums = Vector::Zero(cover.size());
  for (const Stroke& s : g.strokes) sums[pixel(s)] += 1.0;
  add_sums(sums, SplineGram::Take::Value, 1.0, result.points);
  add_sums(sums, SplineGram::Take::Value, problem.beta, result.penalty);
  const double alpha = problem.alpha_of(part);
  if (!(alpha > 0.0) || part.smoothness.empty()) return result;
  for (const auto take : {SplineGram::Take::SlopeX, SplineGram::Take::SlopeY}) {
    sums.setZero();
    for (Index j = 1; j < part.points(); ++j) {
      if (!part.smoothness.linked(j)) continue;
      const Point step = g.strokes[static_cast<std::size_t>(j)].via - g.strokes[static_cast<std::size_t>(j) - 1].via;
      const double pixels = take == SplineGram::Take::SlopeX ? step.x / cover.pitch_x : step.y / cover.pitch_y;
      const double slope = part.smoothness.scale(j) * pixels;
      sums[pixel(g.strokes[static_cast<std::size_t>(j)])] += slope * slope;
    }
    add_sums(sums, take, alpha, result.penalty);
  }
  return result;
}

void SmoothDwellHessian::product(const Vector& d, Vector& hd) {
  Index first = 0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    Sums& part = sums_[k];
    const Index size = part.points.lattice().size();
    part.density.resize(size);
    part.points.apply_to_stretch(d.segment(first, size), part.density);
    part.to_removal.restrict_to(part.density, coarse_[k]);
    first += size;
  }
  removal_.normal(coarse_, correlated_);
  gather(hd);
  first = 0;
  for (Sums& part : sums_) {
    const Index size = part.points.lattice().size();
    part.density.resize(size);
    part.penalty.apply_to_stretch(d.segment(first, size), part.density);
    hd.segment(first, size) += part.density;
    first += size;
  }
}

void SmoothDwellHessian::removal_gradient(const Vector& r, Vector& g) {
  removal_.adjoint(r, correlated_);
  gather(g);
}

/// What the coarse nodes of each part say of its coefficients.
void SmoothDwellHessian::gather(Vector& result) {
  Index size = 0, first = 0;
  for (const Sums& part : sums_) size += part.points.lattice().size();
  result.resize(size);
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    Sums& part = sums_[k];
    part.to_removal.prolong(correlated_[k], part.density);
    part.points.apply_to_stretch(part.density, result.segment(first, part.points.lattice().size()));
    first += part.points.lattice().size();
  }
}

}  // namespace dwell
