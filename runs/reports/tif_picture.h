#pragma once

#include <string>

#include "runs/reports/tif_run.h"

namespace dwell {

/// The removal function as a PNG file: rates in colour over the displacement from the tool axis.
std::string tif_picture(const TifResult& result);

/// Cross sections through the tool axis along x and along y as a PNG file, with the three best fits, if there are any:
/// of the row and the column of pixels nearest to the axis.
std::string section_picture(const TifResult& result);

/// Measured, best fit (least BIC) and residual side by side as a PNG file: the first two on one scale, the residual
/// blue - white - red about zero. There must be a fit.
std::string fit_picture(const TifResult& result);

/// The transfer function against wavelength as a PNG file, along x, along y and in the mean over all directions, both
/// axes logarithmic; the waves of 50 % and 10 % response marked.
std::string transfer_picture(const TifResult& result);

}  // namespace dwell
