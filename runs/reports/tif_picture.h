#pragma once

#include <string>

#include "runs/drawing/figure_format.h"
#include "runs/reports/tif_run.h"

namespace dwell {

/// The removal function as a figure: rates in colour over the displacement from the tool axis.
std::string tif_picture(const TifResult& result, FigureFormat format = FigureFormat::Png);

/// Cross sections through the tool axis along x and along y, with the three best fits, if there are any:
/// of the row and the column of pixels nearest to the axis.
std::string section_picture(const TifResult& result, FigureFormat format = FigureFormat::Png);

/// Measured, best fit (least BIC) and residual in one figure: the first two on one scale, the residual
/// blue - white - red about zero. There must be a fit.
std::string fit_picture(const TifResult& result, FigureFormat format = FigureFormat::Png);

/// The transfer function against wavelength, along x, along y and in the mean over all directions, both
/// axes logarithmic; the waves of 50 % and 10 % response marked.
std::string transfer_picture(const TifResult& result, FigureFormat format = FigureFormat::Png);

}  // namespace dwell
