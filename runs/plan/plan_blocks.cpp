#include "runs/plan/plan_blocks.h"

namespace dwell {

nlohmann::ordered_json plan_map_block(const Plan& plan) {
  return map_block({plan.options.map, plan.map.grid, plan.map.history, plan.map_pixels, plan.options.aperture,
                    to_string(plan.terms), plan.before});
}

nlohmann::ordered_json plan_tif_block(const Plan& plan) {
  return tif_block(plan.tif, kind_of(plan.tif), plan.tif.samples.history, plan.kernel.volume_factor);
}

nlohmann::ordered_json plan_path_block(const Plan& plan) {
  return path_block(plan.path.kind, plan.metrics, plan.path.notes);
}

DwellFigures plan_dwell_figures(const Plan& plan) {
  return {plan.dwell.sum(), plan.dwell.minCoeff(), plan.dwell.maxCoeff(), plan.step_rms};
}

}  // namespace dwell
