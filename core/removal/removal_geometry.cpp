#include "core/removal/removal_geometry.h"

#include "core/removal/lattice_removal.h"
#include "core/removal/scattered_removal.h"

namespace dwell {

std::unique_ptr<RemovalOperator> make_removal_operator(const RemovalGeometry& g) {
  if (LatticeRemoval::commensurate(g.map, g.strokes))
    return std::make_unique<LatticeRemoval>(g.map, g.pixels, g.kernel, g.strokes, g.threads);
  return std::make_unique<ScatteredRemoval>(g.map, g.pixels, g.kernel, g.strokes, g.threads);
}

}  // namespace dwell
