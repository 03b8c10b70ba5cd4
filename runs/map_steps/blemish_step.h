#pragma once

#include <string>

#include "runs/map_steps/map_step.h"

namespace dwell {

/// The step `blemishes`: removes those of a map that are narrower than its `width` (core/anatomy/blemishes.h).
std::string run_blemishes(HeightMap& map, const MapStep& step, MapStepContext& context);

}  // namespace dwell
