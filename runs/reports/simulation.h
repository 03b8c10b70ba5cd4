#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/form/map_statistics.h"
#include "core/motion/program.h"
#include "runs/base/input_file.h"
#include "runs/base/json_blocks.h"
#include "runs/job/job_options.h"
#include "runs/programs/gcode_reading.h"

namespace dwell {

/// How far the removal by the spline on the map's pixels is from that by the removal function as given, over the
/// aperture [nm].
struct SplineError {
  double rms = 0.0;
  double largest = 0.0;
};

/// The effect of a program on disk on a map.
struct Simulation {
  std::vector<InputFile> inputs;
  Program program;
  FormTerms terms;
  MapFigures map;  // as it was before the run, for the summary
  RemovalFunction tif;
  double volume_factor = 1.0;  // of its kernel
  MapStatistics before;
  MapStatistics after;
  HeightMap removal;                        // [nm], within the aperture
  HeightMap residual;                       // [nm], form terms removed
  std::optional<SplineError> spline_error;  // of an exact simulation; without form terms removed
};

/// Simulates a program file (feed.csv or G-code) on the job's map with the job's removal function; the tool moves
/// continuously. `exact`: with the removal function as given (simulate_exactly), which is slow. `reading`: for
/// G-code that leaves something to its controller. Of the job it uses map, tif, remove, aperture and threads. Throws
/// InputError, Interrupted.
Simulation simulate_file(const std::filesystem::path& program, const GcodeReading& reading, const JobOptions& options,
                         const Progress& progress, bool exact = false);

/// The simulation as JSON text (docs/json.md), units in the keys.
std::string simulation_json(const Simulation& simulation);

}  // namespace dwell
