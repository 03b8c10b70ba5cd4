#include "runs/base/json_blocks.h"

#include <cmath>

#include "core/base/number_text.h"
#include "core/base/utf8_text.h"
#include "core/base/version.h"
#include "solvers/solver_catalogue.h"

namespace dwell {

nlohmann::ordered_json json_of_command(const std::string& command) {
  return {{"schema", kJsonSchema}, {"version", version()}, {"command", command}};
}

namespace {

void escape_bytes(nlohmann::ordered_json& json) {
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    if (!is_utf8(text)) json = with_escaped_bytes(text);
  } else if (json.is_structured()) {
    for (auto& part : json) escape_bytes(part);
  }
}

}  // namespace

std::string json_text(nlohmann::ordered_json json) {
  escape_bytes(json);
  return json.dump(2) + "\n";
}

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json finite_or_null(const std::optional<double>& value) {
  return value ? finite_or_null(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json grid_block(const Grid& grid) {
  return {{"rows", grid.rows},
          {"columns", grid.cols},
          {"pixel_mm", {fewest_digits(grid.pitch_x), fewest_digits(grid.pitch_y)}},
          {"origin_mm", {fewest_digits(grid.origin.x), fewest_digits(grid.origin.y)}}};
}

nlohmann::ordered_json map_block(const MapFigures& map) {
  nlohmann::ordered_json block = {{"file", map.file}};
  block.update(grid_block(map.grid));
  block.update({{"history", map.history},
                {"valid_pixels", map.valid_pixels},
                {"aperture", map.aperture},
                {"aperture_pixels", map.statistics.valid_pixels},
                {"removed", map.removed},
                {"pv_nm", map.statistics.pv},
                {"pvr_nm", finite_or_null(map.statistics.pvr)},
                {"rms_nm", map.statistics.rms},
                {"mean_nm", map.statistics.mean}});
  return block;
}

nlohmann::ordered_json tif_block(const RemovalFunction& tif, const std::string& kind,
                                 const std::vector<std::string>& history, std::optional<double> volume_factor) {
  nlohmann::ordered_json block = {
      {"kind", kind},        {"history", history},     {"peak_nm_per_s", tif.peak}, {"volume_nm_mm2_per_s", tif.volume},
      {"fwhm_mm", tif.fwhm}, {"radius_mm", tif.radius}};
  if (volume_factor) block["volume_factor"] = *volume_factor;
  return block;
}

nlohmann::ordered_json residual_block(const std::string& removed, const MapStatistics& left) {
  return {{"removed", removed},
          {"rms_nm", left.rms},
          {"pv_nm", left.pv},
          {"pvr_nm", finite_or_null(left.pvr)},
          {"mean_nm", left.mean}};
}

nlohmann::ordered_json path_block(const std::string& kind, const PathMetrics& metrics,
                                  const std::vector<std::string>& notes) {
  return {{"kind", kind},
          {"points", metrics.points},
          {"length_mm", metrics.length},
          {"longest_jump_mm", metrics.longest_jump},
          {"lifts", metrics.lifts},
          {"notes", notes}};
}

nlohmann::ordered_json solve_block(const SolverSummary& solver) {
  return {{"solver", to_string(solver.kind)},
          {"status", to_string(solver.status)},
          {"message", solver.message},
          {"iterations", solver.iterations},
          {"operator_applications", solver.operator_applications},
          {"coarse_pairs", solver.coarse_pairs},
          {"wall_s", solver.seconds}};
}

nlohmann::ordered_json dwell_block(const DwellFigures& dwell) {
  return {{"total_s", dwell.total}, {"min_s", dwell.min}, {"max_s", dwell.max}, {"step_rms_s", dwell.step_rms}};
}

ProgramFigures program_figures(const Program& program, const ExactResidual& residual, const std::string& removed,
                               std::optional<double> max_feed) {
  return {program.file,
          program.steps.size(),
          program.removing_length(),
          program.run_seconds(max_feed),
          program.rapid_seconds(max_feed),
          residual.statistics,
          residual.standard_error,
          residual.ripple,
          residual.ripple_error,
          residual.total(),
          residual.checked,
          residual.lattice_error,
          removed,
          program.notes};
}

nlohmann::ordered_json program_block(const ProgramFigures& program) {
  return {{"file", program.file},
          {"steps", program.steps},
          {"removing_length_mm", program.removing_length},
          {"total_s", program.seconds},
          {"lift_s", program.rapid_seconds},
          {"removed", program.removed},
          {"residual_rms_nm", program.residual.rms},
          {"residual_pv_nm", program.residual.pv},
          {"residual_pvr_nm", finite_or_null(program.residual.pvr)},
          {"residual_mean_nm", program.residual.mean},
          {"residual_rms_standard_error_nm", program.standard_error},
          {"ripple_within_pixels_rms_nm", program.ripple},
          {"ripple_within_pixels_standard_error_nm", program.ripple_error},
          {"total_rms_nm", program.total},
          {"pixels_checked", program.checked},
          {"lattice_error_rms_nm", program.lattice_error},
          {"notes", program.notes}};
}

nlohmann::ordered_json trial_block(const Weights& weights, const TradeOff& trade_off, double objective,
                                   long operator_applications) {
  return {{"smoothness", weights.smoothness},
          {"time_price_nm2_per_s", weights.time_price},
          {"residual_rms_nm", trade_off.residual_rms},
          {"total_s", trade_off.total},
          {"step_rms_s", trade_off.step_rms},
          {"objective_nm2", objective},
          {"operator_applications", operator_applications}};
}

}  // namespace dwell
