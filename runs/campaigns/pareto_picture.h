#pragma once

#include <string>

#include "runs/campaigns/pareto.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A figure of a sweep: residual RMS against total dwell and against step RMS, a line a smoothness, along the time
/// prices; the points of the front are marked.
std::string pareto_picture(const ParetoSweep& sweep, FigureFormat format = FigureFormat::Png);

}  // namespace dwell
