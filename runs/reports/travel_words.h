#pragma once

#include <string>

#include "runs/plan/machine_program.h"

namespace dwell {

/// The times of a run besides its dwell, for people: "moves between stops 3.10 s, lifted moves 0.00 s and the way down
/// 0.20 s, at maximum feed"; the first only where the tool stops.
std::string travel_words(const TravelTimes& travel);

}  // namespace dwell
