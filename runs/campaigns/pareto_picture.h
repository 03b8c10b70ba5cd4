#pragma once

#include <string>

#include "runs/campaigns/pareto.h"

namespace dwell {

/// A PNG file of a sweep: residual RMS against total dwell and against step RMS, a line a smoothness, along the time
/// prices; the points of the front are marked.
std::string pareto_picture(const ParetoSweep& sweep);

}  // namespace dwell
