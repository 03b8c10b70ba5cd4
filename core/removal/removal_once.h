#pragma once

#include <vector>

#include "core/motion/tool_path.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The removal [nm] at the pixels, in their order, of strokes with the times t [s], for callers that apply an operator
/// only once: coarse_removal_once where the kernel asks for a coarse lattice, else scattered_removal_once, which state
/// errors and cost.
Vector removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                    const std::vector<Stroke>& strokes, const Vector& t, int threads);

}  // namespace dwell
