#pragma once

#include "core/tif/models/removal_model.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// The removal of a spinning disc: r within its radius. A ramp of the width `blur` replaces the jump at the rim,
/// because a fit cannot follow a jump. Both [mm], radius > 0.
RemovalShape disc_shape(double radius, double blur);

/// Its row in removal_models(). A specification gives the slope of the rate, and keeps the closed form.
RemovalModel disc_model();

}  // namespace dwell
