#pragma once

#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// Pixels that a plan's fit leaves out, since blemishes lie on them.
struct LeftOut {
  std::vector<Index> pixels;        // linear indices, ascending
  Index blemishes = 0;              // that they belong to
  double fit_rms = 0.0;             // of what is left on the others, about zero, as the solver predicts [nm]
  double rms_before = 0.0;          // with all pixels in the fit: of what that left on all of them, about zero [nm]
  double rms_before_without = 0.0;  // and of what it left on those that are now in the fit [nm]
};

}  // namespace dwell
