#pragma once

#include <functional>

#include "core/base/coarse_factor.h"
#include "core/numerics/spline_surface.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// How often a map's pixel is divided along x and y into the inner lattice on which the removal is a spline.
struct PixelDivision {
  Index x = 1;
  Index y = 1;

  bool operator==(const PixelDivision&) const = default;
};

/// A removal function on a lattice, that of a map's pixels or one that divides them: the definition of b that every
/// operator shares. The rate at displacement d is the cubic B-spline through samples at whole pitches of the lattice
/// from the tool axis; the samples are scaled by `volume_factor` so that their sum times the area of a cell is the
/// volume rate of the removal function.
struct RemovalKernel {
  SplineSurface surface;       // rate [nm/s] over displacement from the axis [mm]; odd size, axis in the middle
  double volume_factor = 1.0;  // scale applied to the samples
  double energy = 0.0;         // sum of squared samples: squared norm of the column of a dwell point inside the part
  Index half_rows = 0;         // coefficients reach from -half to +half pixels about the axis
  Index half_cols = 0;
  PixelDivision division;  // of the map's pixels into the pitch of the samples
  /// Where the removal function is much wider than a pixel, operators take the removal for a spline on every so many
  /// pixels (CoarseRemoval); 1 = on the samples' own lattice. The samples do not depend on it.
  CoarseFactor coarse{};

  double rate(Point displacement) const { return surface(displacement); }
};

/// The rate [nm/s] that a pixel of hx by hy [mm] gets at a displacement from the tool axis: the value of the formula,
/// or of the spline through the samples, at its centre; of a disc, whose rim is a jump, the mean over the pixel. The
/// function refers to `tif`.
std::function<double(Point)> rate_at_pixel(const RemovalFunction& tif, double hx, double hy);

/// The kernel of the removal function's mean over pixels of hx by hy [mm] (mean_rate_over_pixel) on a lattice that
/// divides them: with it, the removal at a pixel's centre is the mean over the pixel. Throws InputError if the removal
/// function's FWHM is below 2 pixels. Cost O(size of the removal function on the inner lattice).
RemovalKernel pixel_kernel(const RemovalFunction& tif, double hx, double hy, PixelDivision division = {});

/// Samples `tif` at the pitch (pitch_x, pitch_y) [mm]. Throws InputError if the removal function is too narrow for
/// the pitch: FWHM below 2 pixels, or a volume factor outside 0.9 .. 1.1. Cost O(size of the removal function).
RemovalKernel removal_kernel(const RemovalFunction& tif, double pitch_x, double pitch_y);

}  // namespace dwell
