#include "runs/reports/plan_summary.h"

#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/version.h"
#include "runs/base/inputs_json.h"
#include "runs/reports/options_json.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

Json map_json(const PlannedJob& plan) {
  const Grid& g = plan.part().map.grid;
  return {{"file", plan.job.options.map},
          {"rows", g.rows},
          {"columns", g.cols},
          {"pixel_mm", {g.pitch_x, g.pitch_y}},
          {"origin_mm", {g.origin.x, g.origin.y}},
          {"history", plan.part().map.history},
          {"valid_pixels", plan.job.map_pixels},
          {"aperture", to_string(plan.job.options.aperture)},
          {"aperture_pixels", plan.part().before.valid_pixels},
          {"pv_nm", plan.part().before.pv},
          {"rms_nm", plan.part().before.rms}};
}

Json tif_json(const PlannedJob& plan) {
  return {{"kind", kind_of(plan.part().tif)},
          {"history", plan.part().tif.samples.history},
          {"peak_nm_per_s", plan.part().tif.peak},
          {"volume_nm_mm2_per_s", plan.part().tif.volume},
          {"fwhm_mm", plan.part().tif.fwhm},
          {"radius_mm", plan.part().tif.radius},
          {"volume_factor", plan.part().kernel.volume_factor}};
}

Json solve_json(const PlannedJob& plan) {
  const Certificate& c = plan.dwell.certificate;
  return {{"solver", to_string(plan.dwell.solver.kind)},
          {"status", to_string(plan.dwell.solver.status)},
          {"message", plan.dwell.solver.message},
          {"iterations", plan.dwell.solver.iterations},
          {"operator_applications", plan.dwell.solver.operator_applications},
          {"coarse_pairs", plan.dwell.solver.coarse_pairs},
          {"wall_s", plan.dwell.solver.seconds},
          {"certificate",
           {{"objective_nm2", c.objective},
            {"bound_violation_s", c.bound_violation},
            {"projected_gradient_relative", c.projected_gradient},
            {"dual_infeasibility_relative", c.dual_infeasibility},
            {"complementarity_s", c.complementarity}}}};
}

/// How the weights were found: the trials in order.
Json search_json(const WeightTrials& search) {
  Json trials = Json::array();
  for (const TriedWeights& t : search.trials) {
    trials.push_back({{"smoothness", t.weights.smoothness},
                      {"time_price_nm2_per_s", t.weights.time_price},
                      {"residual_rms_nm", t.trade_off.residual_rms},
                      {"total_s", t.trade_off.total},
                      {"step_rms_s", t.trade_off.step_rms},
                      {"objective_nm2", t.objective},
                      {"operator_applications", t.operator_applications}});
  }
  return {{"criterion", search.criterion}, {"chosen", search.chosen}, {"trials", trials}};
}

Json weights_json(const PlannedJob& plan) {
  Json weights{{"smoothness", plan.dwell.weights.smoothness}, {"time_price_nm2_per_s", plan.dwell.weights.time_price}};
  if (plan.dwell.search) weights["search"] = search_json(*plan.dwell.search);
  return weights;
}

}  // namespace

std::string plan_summary_text(const PlannedJob& plan, const WrittenPlan& written) {
  const Json summary = {
      {"schema", 1},
      {"version", version()},
      {"map", map_json(plan)},
      {"tif", tif_json(plan)},
      {"path",
       {{"kind", plan.laid.path.kind},
        {"points", plan.laid.metrics.points},
        {"length_mm", plan.laid.metrics.length},
        {"longest_jump_mm", plan.laid.metrics.longest_jump},
        {"lifts", plan.laid.metrics.lifts},
        {"notes", plan.laid.path.notes}}},
      {"weights", weights_json(plan)},
      {"solve", solve_json(plan)},
      {"dwell",
       {{"total_s", plan.dwell.seconds.sum()},
        {"min_s", plan.dwell.seconds.minCoeff()},
        {"max_s", plan.dwell.seconds.maxCoeff()},
        {"step_rms_s", plan.dwell.step_rms}}},
      {"residual",
       {{"removed", to_string(plan.part().form)},
        {"rms_nm", plan.dwell.residual.rms},
        {"pv_nm", plan.dwell.residual.pv}}},
      {"feed",
       {{"motion", to_string(plan.laid.motion)},
        {"min_mm_per_min", units::mm_per_min(plan.program.feed.min_speed)},
        {"max_mm_per_min", units::mm_per_min(plan.program.feed.max_speed)},
        {"segments_limited", plan.program.feed.segments_limited},
        {"segments_infeasible", plan.program.feed.segments_infeasible}}},
      {"program",
       {{"file", "program.nc"},
        {"total_s", written.program_seconds},
        {"residual_rms_nm", written.simulated.rms},
        {"residual_pv_nm", written.simulated.pv},
        {"feed_table", written.table_has_same_steps ? "same steps" : "simulated"}}},
      {"limits", written.limits},
      {"options", options_json(plan.job)},
      {"inputs", inputs_json(plan.job.inputs)},
  };
  return summary.dump(2) + "\n";
}

}  // namespace dwell
