#include "core/removal/removal_geometry.h"

#include <utility>

#include "core/removal/coarse_removal.h"
#include "core/removal/inner_lattice.h"
#include "core/removal/lattice_removal.h"
#include "core/removal/scattered_removal.h"
#include "core/removal/stacked_removal.h"

namespace dwell {

RemovalGeometry removal_geometry(const Grid& map, const std::vector<Index>& pixels, RemovalKernel kernel,
                                 std::vector<Stroke> strokes, int threads) {
  InnerLattice lattice = divide_pixels(map, pixels, kernel.division);
  return {lattice.grid, std::move(lattice.pixels), std::move(kernel), std::move(strokes), threads};
}

std::unique_ptr<RemovalOperator> make_removal_operator(const RemovalGeometry& g) {
  if (g.kernel.coarse != CoarseFactor{})
    return std::make_unique<CoarseRemoval>(g.lattice, g.pixels, g.kernel, g.strokes, g.threads);
  if (LatticeRemoval::commensurate(g.lattice, g.strokes))
    return std::make_unique<LatticeRemoval>(g.lattice, g.pixels, g.kernel, g.strokes, g.threads);
  return std::make_unique<ScatteredRemoval>(g.lattice, g.pixels, g.kernel, g.strokes, g.threads);
}

std::unique_ptr<RemovalOperator> make_removal_operator(
    const std::vector<std::shared_ptr<const RemovalGeometry>>& geometries) {
  if (geometries.size() == 1) return make_removal_operator(*geometries.front());
  std::vector<std::unique_ptr<RemovalOperator>> parts;
  parts.reserve(geometries.size());
  for (const auto& geometry : geometries) parts.push_back(make_removal_operator(*geometry));
  return std::make_unique<StackedRemoval>(std::move(parts));
}

}  // namespace dwell
