#include "runs/reports/plan_blocks.h"

#include "runs/job/line_profile_map.h"

namespace dwell {

nlohmann::ordered_json plan_map_block(const Job& job) {
  const Part& part = *job.part;
  return map_block({surface_file(job.options), part.map.grid, part.map.history, job.map_pixels,
                    to_string(job.options.aperture), to_string(part.form), part.before});
}

nlohmann::ordered_json plan_tif_block(const Job& job) {
  const RemovalFunction& tif = job.part->tif;
  return tif_block(tif, kind_of(tif), tif.samples.history, job.part->kernel.volume_factor);
}

nlohmann::ordered_json plan_path_block(const LaidPath& laid) {
  return path_block(laid.path.kind, laid.metrics, laid.path.notes);
}

DwellFigures plan_dwell_figures(const DwellPlan& plan) {
  return {plan.seconds.sum(), plan.seconds.minCoeff(), plan.seconds.maxCoeff(), plan.step_rms};
}

}  // namespace dwell
