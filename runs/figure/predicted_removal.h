#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "core/tif/removal_function.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {

/// What a motion removes with a tool of several widths over its own, on the pixels of a map and `margin` [mm] around
/// all of them, also where the map has no data: a measured removal that lies elsewhere is to find it. Throws InputError
/// for a tool that is too narrow for the pixels, Interrupted. Cost: a simulation for each width.
PredictedRemoval predict_removal(const HeightMap& map, const RemovalFunction& tif, const Program& motion,
                                 const std::vector<double>& widths, double margin, int threads,
                                 const Progress& progress = {});

/// The widths over which a registration fits: the known one, and a little narrower and wider.
inline const std::vector<double> kRegisteredWidths{0.93, 1.0, 1.07};

}  // namespace dwell
