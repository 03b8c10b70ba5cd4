#include "core/removal/inner_lattice.h"

#include <limits>
#include <stdexcept>

namespace dwell {

InnerLattice divide_pixels(const Grid& map, const std::vector<Index>& pixels, PixelDivision division) {
  if (division == PixelDivision{}) return {map, pixels};
  InnerLattice inner;
  inner.grid = {(map.rows - 1) * division.y + 1, (map.cols - 1) * division.x + 1,
                map.pitch_x / static_cast<double>(division.x), map.pitch_y / static_cast<double>(division.y),
                map.origin};
  if (inner.grid.size() > std::numeric_limits<std::int32_t>::max())
    throw std::length_error("inner lattice has more than 2^31 nodes");
  inner.pixels.reserve(pixels.size());
  for (const Index i : pixels)
    inner.pixels.push_back(inner.grid.index(i / map.cols * division.y, i % map.cols * division.x));
  return inner;
}

}  // namespace dwell
