#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

#include "bench/budget.h"

namespace dwell::bench {

struct PlanRunOptions {
  long size = 4096;       // edge of the map [pixels]
  double longest = 60.0;  // that a plan may take [s]
  int threads = 2;
  std::filesystem::path data;  // public mirrors
};

/// Times `dwell plan` as a user calls it, a process each, from files to the folder with program.nc: a made-up map in
/// NPY with a Gaussian tool that dwells at every 4th pixel, running through and halting; the mirror udo-raster, if
/// `data` has it; and a small map with one thread and with two where only one processor is to be had, where threads
/// that wait by spinning would take the processor from those that work. One entry each: name, what, threads, size, and
///   seconds, cpu_seconds, peak_memory  of the process [s], [s], [bytes]
///   solver_seconds, points, status, residual_rms, exit_code  as summary.json says
/// or "failed" or "skipped" with the reason. The time to make the map is not included.
nlohmann::json run_plans(const PlanRunOptions& options, const Budget& budget);

}  // namespace dwell::bench
