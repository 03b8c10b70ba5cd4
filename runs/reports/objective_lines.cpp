#include "runs/reports/objective_lines.h"

#include <fmt/format.h>

#include "runs/plan/objective_rows.h"

namespace dwell {

std::string objective_line(const PlannedJob& plan) {
  const FitObjective& objective = plan.job.options.objective;
  if (!objective.has_slopes()) return "";
  const double length = slope_length(plan.part(), objective), left = plan.dwell.certificate.residual_rms;
  return fmt::format("objective {}: slopes count times {:.4g} mm; {} left by the solver\n", to_string(objective),
                     length,
                     objective.slope_share < 1.0 ? fmt::format("RMS of both {:.4g} nm", left)
                                                 : fmt::format("{:.4g} urad RMS, mean slopes aside,", left / length));
}

nlohmann::ordered_json objective_block(const PlannedJob& plan) {
  const FitObjective& objective = plan.job.options.objective;
  return {{"of", to_string(objective)},
          {"slope_share", objective.slope_share},
          {"slope_length_mm", slope_length(plan.part(), objective)},
          {"left_rms_nm", plan.dwell.certificate.residual_rms}};
}

}  // namespace dwell
