#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "core/base/grid.h"
#include "core/form/map_statistics.h"
#include "core/motion/program.h"
#include "core/removal/exact_residual.h"
#include "core/tif/removal_function.h"
#include "paths/metrics/path_metrics.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

/// The blocks that the JSON of every command is built from (docs/json.md). Each is made in one place, so that the same
/// quantity has the same key in every command. Units are in the keys.

/// The number of the layout: "schema" of every JSON that the program writes. It changes when a key goes or gets another
/// meaning; a new key leaves it. Version 0.1 of the program wrote layout 1.
inline constexpr int kJsonSchema = 2;

/// "schema", "version" and "command", with which the JSON of every command begins.
nlohmann::ordered_json json_of_command(const std::string& command);

/// The JSON as text, indented by two, with a line end. Bytes that are no UTF-8, as names of files may hold, are escaped
/// (core/base/utf8_text.h).
std::string json_text(nlohmann::ordered_json json);

/// The number, or null where it is not finite: JSON has neither infinity nor NaN.
nlohmann::ordered_json finite_or_null(double value);
nlohmann::ordered_json finite_or_null(const std::optional<double>& value);

/// "rows", "columns", "pixel_mm", "origin_mm".
nlohmann::ordered_json grid_block(const Grid& grid);

/// What the JSON of a command says of a map.
struct MapFigures {
  std::string file;  // as the user named it
  Grid grid;
  std::vector<std::string> history;  // how it was made, a step each
  Index valid_pixels = 0;            // after the steps, before the aperture
  std::string aperture = "map";      // as the user gave it
  std::string removed;               // form terms without which it was measured
  MapStatistics statistics;          // within the aperture, `removed` taken out
};
nlohmann::ordered_json map_block(const MapFigures& map);

/// `kind` says where the removal function comes from: kind_of(tif), or the calibration that made it. `history` is how
/// its samples were made. `volume_factor` is that of the kernel, where the function was resampled to a map.
nlohmann::ordered_json tif_block(const RemovalFunction& tif, const std::string& kind,
                                 const std::vector<std::string>& history, std::optional<double> volume_factor = {});

/// A surface that something leaves: "removed", "rms_nm", "pv_nm", "pvr_nm", "mean_nm".
nlohmann::ordered_json residual_block(const std::string& removed, const MapStatistics& left);

nlohmann::ordered_json path_block(const std::string& kind, const PathMetrics& metrics,
                                  const std::vector<std::string>& notes);

/// Without a certificate, which only a plan has.
nlohmann::ordered_json solve_block(const SolverSummary& solver);

/// The dwell times of a path [s].
struct DwellFigures {
  double total = 0.0, min = 0.0, max = 0.0;
  double step_rms = 0.0;  // change between neighbours
};
nlohmann::ordered_json dwell_block(const DwellFigures& dwell);

/// A program as read back from disk and the surface that it leaves.
struct ProgramFigures {
  std::string file;
  std::size_t steps = 0;
  double removing_length = 0.0;  // [mm]
  double seconds = 0.0;          // of the run [s]
  double rapid_seconds = 0.0;    // of that, of rapids [s]
  MapStatistics residual;        // by simulation, form terms removed
  double standard_error = 0.0;   // of its RMS [nm]
  double ripple = 0.0;           // within pixels, RMS [nm]
  double ripple_error = 0.0;     // standard error of it [nm]
  double total = 0.0;            // both [nm]
  Index checked = 0;             // pixels at which the removal function itself was integrated
  double lattice_error = 0.0;    // RMS of the lattice's removal less the exact one [nm]
  std::string removed;           // which form terms
  std::vector<std::string> notes;
};
/// `max_feed` [mm/s]: that of rapids, where it is known (Program::rapid_seconds).
ProgramFigures program_figures(const Program& program, const ExactResidual& residual, const std::string& removed,
                               std::optional<double> max_feed = {});
nlohmann::ordered_json program_block(const ProgramFigures& program);

/// A solve with given weights and its result: a trial of a search, or a point of a sweep.
nlohmann::ordered_json trial_block(const Weights& weights, const TradeOff& trade_off, double objective,
                                   long operator_applications);

}  // namespace dwell
