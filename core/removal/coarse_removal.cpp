#include "core/removal/coarse_removal.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "core/removal/matched_kernel.h"

namespace dwell {
namespace {

constexpr double kTail = 1e-8;  // of the largest coefficient: far below the spline's own error

std::vector<Index> every_node(const Grid& grid) {
  std::vector<Index> nodes(static_cast<std::size_t>(grid.size()));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  return nodes;
}

}  // namespace

// Samples at a coarse pitch miss or count parts of the rim, where the removal function ends with a jump: the sum of the
// coefficients, which is what constant dwell removes, is made that of the kernel.
RemovalKernel coarse_kernel(const RemovalKernel& kernel) {
  RemovalKernel coarse = matched_kernel(kernel, kernel.coarse, kTail);
  const auto sum = [](const RemovalKernel& k) {
    const std::vector<double>& c = k.surface.coefficients();
    return std::accumulate(c.begin(), c.end(), 0.0);
  };
  // The kernel of a change of the tool takes nothing in all: its sum is rounding.
  constexpr double kNoVolume = 1e-3;
  const auto size = [](const RemovalKernel& k) {
    double total = 0.0;
    for (const double c : k.surface.coefficients()) total += std::abs(c);
    return total;
  };
  if (!(std::abs(sum(kernel)) > kNoVolume * size(kernel))) return coarse;
  const double cells = static_cast<double>(kernel.coarse.x * kernel.coarse.y);
  const double scale = sum(kernel) / (cells * sum(coarse));
  std::vector<double> scaled = coarse.surface.coefficients();
  for (double& c : scaled) c *= scale;
  coarse.surface = SplineSurface::with_coefficients(coarse.surface.grid(), std::move(scaled));
  return coarse;
}

CoarseRemoval::CoarseRemoval(const Grid& map, std::vector<Index> pixels, const RemovalKernel& kernel,
                             const std::vector<Stroke>& strokes, int threads)
    : RemovalOperator(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size())),
      pixels_(std::move(pixels)),
      sampling_(map, kernel.coarse, threads),
      nodes_(sampling_.lattice(), every_node(sampling_.lattice()), coarse_kernel(kernel), strokes, threads),
      coefficients_(sampling_.lattice().size()) {}

void CoarseRemoval::do_apply(const Vector& t, Vector& removal) {
  nodes_.apply(t, coefficients_);
  sampling_.sample(coefficients_, pixels_, removal);
}

void CoarseRemoval::do_apply_adjoint(const Vector& residual, Vector& t) {
  sampling_.spread(pixels_, residual, coefficients_);
  nodes_.apply_adjoint(coefficients_, t);
}

Vector coarse_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                           const std::vector<Stroke>& strokes, const Vector& t, int threads) {
  SplineSampling sampling(map, kernel.coarse, threads);
  const Vector coefficients = scattered_removal_once(sampling.lattice(), every_node(sampling.lattice()),
                                                     coarse_kernel(kernel), strokes, t, threads);
  Vector removal;
  sampling.sample(coefficients, pixels, removal);
  return removal;
}

}  // namespace dwell
