#pragma once

#include <optional>
#include <vector>

#include "core/base/grid_limit.h"
#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/map/point_bins.h"

namespace dwell {

/// How points that lie on no grid become a map.
struct ScatterOptions {
  double pitch = 0.0;           // of the map in both directions [mm], > 0
  std::optional<double> reach;  // pixels farther from the nearest point have no data [mm]; default 1.5 spacings
};

struct ScatterSummary {
  double spacing = 0.0;  // of the points: that of a square grid as dense, median over the part [mm]
  double reach = 0.0;    // that was taken [mm]
  Index pixels = 0;      // with data
};

/// The surface through scattered points. At each pixel a quadratic polynomial in x and y is fitted to the points
/// around it by weighted least squares (moving least squares: Lancaster and Salkauskas, Math. Comp. 37 (1981),
/// 141-158): up to three points in each of eight sectors, so that densely sampled tracks far apart serve as well, with
/// weight (1 - (d/D)^2)^2 at distance d, D the search radius of three reaches. Polynomials up to degree 2 come out
/// exactly; noise is averaged. Where the points do not determine a quadratic, a plane is taken. A pixel has data if a
/// point is within the reach and the points surround it: none of its sides is empty over more than 180 degrees, or a
/// point is within half a spacing. Points without a height (NaN) are left out. Throws InputError for fewer than six
/// points, or points all at one place; Interrupted. Cost O(pixels x points within the search radius).
HeightMap scattered_surface(std::vector<HeightPoint> points, const Grid& grid, const ScatterOptions& options,
                            ScatterSummary& summary, int threads, const Progress& progress = {});

/// The grid of this pitch from the smallest x and y of the points, or from `origin`, over all of them. Throws
/// InputError beyond the limit.
Grid grid_over(const std::vector<HeightPoint>& points, double pitch, std::optional<Point> origin,
               const PixelLimit& limit = {});

}  // namespace dwell
