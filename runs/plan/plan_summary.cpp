#include "runs/plan/plan_summary.h"

#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/version.h"
#include "runs/base/inputs_json.h"
#include "runs/plan/options_json.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

Json map_json(const Plan& plan) {
  const Grid& g = plan.map.grid;
  return {{"file", plan.options.map},
          {"rows", g.rows},
          {"columns", g.cols},
          {"pixel_mm", {g.pitch_x, g.pitch_y}},
          {"origin_mm", {g.origin.x, g.origin.y}},
          {"history", plan.map.history},
          {"valid_pixels", plan.map_pixels},
          {"aperture", plan.options.aperture},
          {"aperture_pixels", plan.before.valid_pixels},
          {"pv_nm", plan.before.pv},
          {"rms_nm", plan.before.rms}};
}

Json tif_json(const Plan& plan) {
  return {{"kind", kind_of(plan.tif)},
          {"history", plan.tif.samples.history},
          {"peak_nm_per_s", plan.tif.peak},
          {"volume_nm_mm2_per_s", plan.tif.volume},
          {"fwhm_mm", plan.tif.fwhm},
          {"radius_mm", plan.tif.radius},
          {"volume_factor", plan.kernel.volume_factor}};
}

Json solve_json(const Plan& plan) {
  const Certificate& c = plan.certificate;
  return {{"solver", to_string(plan.solver.kind)},
          {"status", to_string(plan.solver.status)},
          {"message", plan.solver.message},
          {"iterations", plan.solver.iterations},
          {"operator_applications", plan.solver.operator_applications},
          {"coarse_pairs", plan.solver.coarse_pairs},
          {"wall_s", plan.solver.seconds},
          {"certificate",
           {{"objective_nm2", c.objective},
            {"bound_violation_s", c.bound_violation},
            {"projected_gradient_relative", c.projected_gradient},
            {"dual_infeasibility_relative", c.dual_infeasibility},
            {"complementarity_s", c.complementarity}}}};
}

/// How the weights were found: the trials in order.
Json search_json(const PlanSearch& search) {
  Json trials = Json::array();
  for (const PlanTrial& t : search.trials) {
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

Json weights_json(const Plan& plan) {
  Json weights{{"smoothness", plan.weights.smoothness}, {"time_price_nm2_per_s", plan.weights.time_price}};
  if (plan.search) weights["search"] = search_json(*plan.search);
  return weights;
}

}  // namespace

std::string plan_summary_text(const Plan& plan, const WrittenPlan& written) {
  const Json summary = {
      {"schema", 1},
      {"version", version()},
      {"map", map_json(plan)},
      {"tif", tif_json(plan)},
      {"path",
       {{"kind", plan.path.kind},
        {"points", plan.metrics.points},
        {"length_mm", plan.metrics.length},
        {"longest_jump_mm", plan.metrics.longest_jump},
        {"lifts", plan.metrics.lifts},
        {"notes", plan.path.notes}}},
      {"weights", weights_json(plan)},
      {"solve", solve_json(plan)},
      {"dwell",
       {{"total_s", plan.dwell.sum()},
        {"min_s", plan.dwell.minCoeff()},
        {"max_s", plan.dwell.maxCoeff()},
        {"step_rms_s", plan.step_rms}}},
      {"residual", {{"removed", to_string(plan.terms)}, {"rms_nm", plan.residual.rms}, {"pv_nm", plan.residual.pv}}},
      {"feed",
       {{"motion", to_string(plan.motion)},
        {"min_mm_per_min", units::mm_per_min(plan.feed.min_speed)},
        {"max_mm_per_min", units::mm_per_min(plan.feed.max_speed)},
        {"segments_limited", plan.feed.segments_limited},
        {"segments_infeasible", plan.feed.segments_infeasible}}},
      {"program",
       {{"file", "program.nc"},
        {"total_s", written.program_seconds},
        {"residual_rms_nm", written.simulated.rms},
        {"residual_pv_nm", written.simulated.pv},
        {"feed_table", written.table_has_same_steps ? "same steps" : "simulated"}}},
      {"limits", plan.limits},
      {"options", options_json(plan)},
      {"inputs", inputs_json(plan.inputs)},
  };
  return summary.dump(2) + "\n";
}

}  // namespace dwell
