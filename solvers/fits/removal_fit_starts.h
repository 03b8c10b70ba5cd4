#pragma once

#include <vector>

#include "core/map/height_map.h"
#include "core/tif/models/removal_models.h"

namespace dwell {

/// Where a fit of a model to samples may start: x, y, peak, then the model's parameters, from the samples' moments.
/// More than one where the moments do not tell (which way a D looks, how far a pad is out of its axis). Parameters that
/// have a fallback and are not fitted take it. Throws InputError if the samples remove nothing.
std::vector<std::vector<double>> removal_fit_starts(const HeightMap& rates, const RemovalModel& model);

}  // namespace dwell
