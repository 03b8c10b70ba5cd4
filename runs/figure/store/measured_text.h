#pragma once

#include <string>

#include "runs/figure/store/measured_step.h"

namespace dwell {

/// What a measurement says, for people: registration, split, decisions, convergence, bands, and whether another run
/// pays. With an error of orientation, what is known up to there.
std::string measured_text(const MeasuredStep& step, double fwhm);

}  // namespace dwell
