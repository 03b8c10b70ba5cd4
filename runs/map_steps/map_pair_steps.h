#pragma once

#include <string>

#include "runs/map_steps/map_step.h"

namespace dwell {

/// The steps that need another map, or marks on it: see their help in runs/map_steps/map_steps.cpp. Each does its work
/// in place and returns what it did. Throw InputError.
std::string subtract_map(HeightMap& map, const MapStep& step, MapStepContext& context);
std::string average_maps(HeightMap& map, const MapStep& step, MapStepContext& context);
std::string register_on_map(HeightMap& map, const MapStep& step, MapStepContext& context);
std::string move_by_fiducials(HeightMap& map, const MapStep& step, MapStepContext& context);

}  // namespace dwell
