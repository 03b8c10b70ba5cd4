#pragma once

#include <vector>

#include "core/map/height_map.h"
#include "core/tif/models/removal_model.h"

namespace dwell {

/// Where a fit of a model to samples may start: x, y, peak, then the model's parameters, from the samples' moments.
/// More than one where the moments do not decide (which way a D points, how far a pad lies from the tool axis).
/// Parameters that are not fitted take their fallback if they have one. Throws InputError if the samples remove
/// nothing.
std::vector<std::vector<double>> removal_fit_starts(const HeightMap& rates, const RemovalModel& model);

}  // namespace dwell
