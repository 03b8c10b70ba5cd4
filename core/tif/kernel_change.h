#pragma once

#include "core/tif/removal_function.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// How a kernel changes with a small error of tool or machine: kernels of the derivative of the rate, on the lattice of
/// the kernel, which operators take like any other. Their volume is zero, up to rounding.

/// By the logarithm of the tool's width, with the volume that it takes in a second the same [nm/s]: the difference of
/// pixel_kernel for tools two per cent wider and narrower (only wider, where a narrower one is too narrow for the
/// pixels), over that of their widths. hx, hy: the map's pixels [mm], of which `kernel` is made. Throws as
/// pixel_kernel.
RemovalKernel kernel_by_width(const RemovalFunction& tif, const RemovalKernel& kernel, double hx, double hy);

enum class ShiftAxis { X, Y };

/// By a shift of the tool along an axis, with the sign of the slope of the rate [nm/s/mm]: the spline through the
/// slopes of `kernel` at its lattice's nodes. Cost O(size).
RemovalKernel kernel_by_shift(const RemovalKernel& kernel, ShiftAxis axis);

/// The kernel times a number.
RemovalKernel times(RemovalKernel kernel, double factor);

}  // namespace dwell
