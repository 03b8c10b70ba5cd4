#include "runs/plan/counted_pixels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/form/form.h"
#include "core/form/form_polynomials.h"
#include "core/removal/simulate.h"

namespace dwell {
namespace {

/// Puts the pixels of `beside` into `map`, less the form of `counted`, which has data at the pixels that count.
void put_beside(const HeightMap& beside, const HeightMap& counted, const FormTerms& form, int threads, HeightMap& map) {
  const std::vector<Index> pixels = finite_pixels(counted);
  const FormPolynomials polynomials(counted.grid, pixels, form, {}, threads);
  const FormPolynomials::Polynomial removed = polynomials.fit(counted.values);
  for (const Index pixel : finite_pixels(beside)) {
    const auto i = static_cast<std::size_t>(pixel);
    map.values[i] = beside.values[i] - polynomials.value_at(removed, pixel);
  }
}

}  // namespace

std::vector<double> weight_roots(const Part& part, const std::vector<Index>& pixels) {
  if (part.weights.empty()) return {};
  std::vector<double> roots;
  roots.reserve(pixels.size());
  double sum = 0.0;
  for (const Index pixel : pixels) {
    roots.push_back(part.weights[static_cast<std::size_t>(pixel)]);
    sum += roots.back();
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, roots.size()));
  for (double& root : roots) root = std::sqrt(root / mean);
  return roots;
}

std::optional<double> weighted_rms(const Part& part, const HeightMap& surface) {
  const std::vector<Index> pixels = finite_pixels(part.map);
  const std::vector<double> roots = weight_roots(part, pixels);
  if (roots.empty()) return std::nullopt;
  Eigen::VectorXd r(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    r[static_cast<Index>(i)] = roots[i] * surface.values[static_cast<std::size_t>(pixels[i])];
  remove_form(form_basis(part.map.grid, pixels, part.form, roots, part.threads), r);
  return r.norm() / std::sqrt(static_cast<double>(pixels.size()));
}

HeightMap shown_figure(const Part& part) {
  HeightMap shown = part.figure;
  if (!part.beside.values.empty()) put_beside(part.beside, part.map, part.form, part.threads, shown);
  return shown;
}

HeightMap shown_surface(const Part& part, HeightMap left, const Program& program, const RemovalKernel& kernel) {
  if (part.beside.values.empty()) return left;
  const auto left_of = [&](const HeightMap& map) {
    return surface_after(map, simulate(program, map, kernel, part.threads));
  };
  put_beside(left_of(part.beside), left_of(part.map), part.form, part.threads, left);
  return left;
}

}  // namespace dwell
