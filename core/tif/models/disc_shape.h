#pragma once

#include "core/tif/models/removal_model.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// r within the radius of a spinning disc, with a ramp of the width `blur` in place of its rim, so that a fit can find
/// it. Both [mm], radius > 0.
RemovalShape disc_shape(double radius, double blur);

/// Its row in removal_models(). A specification gives the slope of the rate, and keeps the closed form.
RemovalModel disc_model();

}  // namespace dwell
