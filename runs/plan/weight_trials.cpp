#include "runs/plan/weight_trials.h"

#include <fmt/format.h>

#include <algorithm>

namespace dwell {

std::string write_trials(const WeightTrials& search) {
  std::string text =
      "smoothness,time_price_nm2_per_s,residual_rms_nm,total_s,step_rms_s,objective_nm2,operator_applications,chosen,"
      "front\n";
  for (std::size_t k = 0; k < search.trials.size(); ++k) {
    const TriedWeights& t = search.trials[k];
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", t.weights.smoothness, t.weights.time_price,
                        t.trade_off.residual_rms, t.trade_off.total, t.trade_off.step_rms, t.objective,
                        t.operator_applications, k == search.chosen ? 1 : 0,
                        std::count(search.front.begin(), search.front.end(), k));
  }
  return text;
}

}  // namespace dwell
