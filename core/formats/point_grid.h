#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/grid_limit.h"
#include "core/formats/xyz_text.h"
#include "core/map/height_map.h"

namespace dwell {

/// Puts points onto the regular grid they lie on; pixels without a point are NaN. With pitch and origin known the
/// grid is that one, up to the farthest point. Otherwise it is inferred (core/numerics/lattice_fit.h) and what is known
/// must agree: a pitch to 1e-3 of itself, an origin to kLatticeTolerance pitches. An axis with one coordinate takes the
/// other's pitch. At least one point. `where` begins error messages, `name` is "map" or "tif" (the option to name).
/// Throws InputError naming the line of a point off the lattice or given twice, and for nine points or more that fill
/// less than a quarter of the grid and of which less than half lie side by side on it: these are scattered;
/// and, before it takes memory for them, for more pixels than the limit. Cost O(n log n + pixels).
HeightMap grid_points(const std::vector<XyzPoint>& points, std::optional<Point> pitch, std::optional<Point> origin,
                      const std::string& where, const std::string& name, const PixelLimit& limit = {});

}  // namespace dwell
