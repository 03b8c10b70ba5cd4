#pragma once

#include <optional>

#include "runs/job/planned_job.h"

namespace dwell {

/// What the plan with another price would leave and take. The model that found the price tells by what factor; what is
/// multiplied are the plan's own figures, so that the estimates compare with them. Of a fraction of the error they are
/// the model's own.
struct PriceEstimates {
  PricedTradeOff half, twice;            // of the price
  double least_rms = 0.0;                // with next to no price [nm]
  std::optional<double> unsmoothed_rms;  // as that, without smoothness [nm]
};

/// Nothing where the price was not found by its worth, or with another smoothness than the plan has, or where the model
/// made slopes small: how heights go with them it does not know.
std::optional<PriceEstimates> price_estimates(const PlannedJob& plan);

/// RMS about zero that the fit left, blemishes that were left out of it aside [nm].
double left_by_fit(const DwellPlan& plan);

}  // namespace dwell
