#include "solvers/matched/model_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr double kKernelTolerance = 0.01;       // of matched_factor, where the kernel allows
constexpr double kLooseKernelTolerance = 0.03;  // for measured removal functions, whose noise is not worth pixels
constexpr Index kFinestFactor = 3, kFinestOfSmallMap = 2, kSmallMap = Index{1} << 18;

CoarseFactor pixels_for(const RemovalKernel& kernel) {
  const CoarseFactor factor = matched_factor(kernel, kKernelTolerance);
  const double gaussian = 0.8 * equivalent_sigma(kernel);
  if (static_cast<double>(std::min(factor.x, factor.y)) > 0.6 * gaussian) return factor;
  return matched_factor(kernel, kLooseKernelTolerance);
}

}  // namespace

CoarseFactor model_pixels(const DwellProblem& problem) {
  CoarseFactor least = pixels_for(problem.parts.front().geometry->kernel);
  for (const DwellPart& part : problem.parts) {
    const CoarseFactor factor = pixels_for(part.geometry->kernel);
    least = {std::min(least.x, factor.x), std::min(least.y, factor.y)};
  }
  return least;
}

CoarseFactor fine_pixels(double sigma, CoarseFactor factor) {
  const double finest = kFinePitch * sigma;
  const double parts = std::max(2.0, std::ceil(static_cast<double>(std::max(factor.x, factor.y)) / finest));
  const auto part = [&](Index q) {
    const auto f = std::max<Index>(1, static_cast<Index>(static_cast<double>(q) / parts));
    return f >= 4 ? f - f % 2 : f;
  };
  return {part(factor.x), part(factor.y)};
}

Index finest_factor(const DwellProblem& problem) {
  return problem.pixels() <= kSmallMap ? kFinestOfSmallMap : kFinestFactor;
}

double narrowest_sigma(const DwellProblem& problem) {
  double least = std::numeric_limits<double>::infinity();
  for (const DwellPart& part : problem.parts) least = std::min(least, equivalent_sigma(part.geometry->kernel));
  return least;
}

double pair_cost(const DwellProblem& problem) {
  double sum = 0.0;
  for (const DwellPart& part : problem.parts) {
    sum += operator_cost(part.geometry->lattice, part.geometry->kernel);
    for (const RemovalChange& change : part.changes) {
      if (change.geometry != part.geometry) sum += operator_cost(change.geometry->lattice, change.geometry->kernel);
    }
  }
  return sum;
}

}  // namespace dwell
