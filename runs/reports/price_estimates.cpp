#include "runs/reports/price_estimates.h"

#include <algorithm>

namespace dwell {

double left_by_fit(const DwellPlan& plan) {
  return plan.left_out ? plan.left_out->fit_rms : plan.residual.rms_about_zero();
}

std::optional<PriceEstimates> price_estimates(const PlannedJob& plan) {
  const DwellPlan& dwell = plan.dwell;
  if (plan.job.options.objective.has_slopes()) return std::nullopt;
  if (!dwell.worth || !(dwell.worth->price > 0.0) || dwell.weights.smoothness != dwell.worth_smoothness ||
      dwell.weights.time_price != dwell.worth->price)
    return std::nullopt;
  const TimePrice& worth = *dwell.worth;
  const TradeOff& here = worth.here.trade_off;
  const bool whole = !(plan.job.options.fraction < 1.0);
  const double rms = whole && here.residual_rms > 0.0 ? left_by_fit(dwell) / here.residual_rms : 1.0;
  const double total = whole && here.total > 0.0 ? dwell.seconds.sum() / here.total : 1.0;
  const auto scaled = [&](PricedTradeOff p) {
    // A higher price leaves no less and takes no longer; where the model is not at rest, it may seem so.
    const bool dearer = p.price > worth.here.price;
    TradeOff& t = p.trade_off;
    t.residual_rms =
        rms * (dearer ? std::max(t.residual_rms, here.residual_rms) : std::min(t.residual_rms, here.residual_rms));
    t.total = total * (dearer ? std::min(t.total, here.total) : std::max(t.total, here.total));
    return p;
  };
  PriceEstimates result{scaled(worth.half), scaled(worth.twice), 0.0, std::nullopt};
  result.least_rms =
      rms * std::min({here.residual_rms, worth.best.trade_off.residual_rms, worth.half.trade_off.residual_rms});
  if (worth.unsmoothed) result.unsmoothed_rms = rms * worth.unsmoothed->trade_off.residual_rms;
  return result;
}

}  // namespace dwell
