#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/numerics/spline_surface.h"

namespace dwell {

/// A map between its pixels: the cubic B-spline that takes every finite height at its pixel
/// (core/numerics/spline_surface.h). The spline needs heights in pixels without data too: there it takes three rings of
/// linear continuation (the mean over the eight directions of 2 h(1) - h(2)), beyond them the height of the nearest
/// pixel. They do not count as data.
class MapSampler {
 public:
  /// Throws InputError if no pixel is finite, Interrupted. Cost and memory O(pixels).
  explicit MapSampler(const HeightMap& map, const Progress& progress = {});

  /// Whether there is data at p: every pixel that bilinear interpolation would use is finite. A pixel's own centre (to
  /// 1e-9 pixels) needs that pixel only; there is no data in the cells that a hole touches, and nothing is
  /// extrapolated.
  bool has_data(Point p) const;

  /// The height at p [nm], NaN where there is no data.
  double operator()(Point p) const;

  /// The surface with its slopes [nm, nm/mm], whether there is data or not: smooth everywhere, for fits.
  SplineSurface::Jet jet(Point p) const;

 private:
  Grid grid_;
  std::vector<unsigned char> valid_;
  double mean_ = 0.0;
  SplineSurface surface_;  // of the heights less the mean
};

}  // namespace dwell
