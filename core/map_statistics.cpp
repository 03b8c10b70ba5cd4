#include "core/map_statistics.h"

#include <cmath>

#include "core/errors.h"

namespace dwell {
namespace {

Eigen::VectorXd heights_without_form(const HeightMap& map, const std::vector<Index>& pixels, const FormTerms& terms) {
  Eigen::VectorXd heights(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    heights[static_cast<Index>(i)] = map.values[static_cast<std::size_t>(pixels[i])];
  }
  if (terms.any()) remove_form(form_basis(map.grid, pixels, terms), heights);
  return heights;
}

}  // namespace

MapStatistics map_statistics(const HeightMap& map, const FormTerms& terms) {
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) throw InputError("map has no finite pixel; PV and RMS need at least one");
  const Eigen::VectorXd heights = heights_without_form(map, pixels, terms);
  MapStatistics statistics;
  statistics.valid_pixels = heights.size();
  statistics.pv = heights.maxCoeff() - heights.minCoeff();
  statistics.rms = std::sqrt(heights.squaredNorm() / static_cast<double>(heights.size()));
  return statistics;
}

HeightMap without_form(const HeightMap& map, const FormTerms& terms) {
  const std::vector<Index> pixels = finite_pixels(map);
  const Eigen::VectorXd heights = heights_without_form(map, pixels, terms);
  HeightMap result = map;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    result.values[static_cast<std::size_t>(pixels[i])] = heights[static_cast<Index>(i)];
  }
  return result;
}

}  // namespace dwell
