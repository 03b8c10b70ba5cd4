#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

#include "bench/budget.h"
#include "bench/measurements.h"
#include "bench/plan_cases.h"

namespace dwell::bench {

/// Times `dwell plan` as a user calls it, a process each, from files to the folder with program.nc, with the program's
/// default weights: large made-up maps in NPY, on two threads and on one; the mirror udo-raster, if `data` has it; and
/// a small map with one thread and with two where only one processor is to be had, where threads that wait by spinning
/// would take the processor from those that work. And how long a plan takes to end that is interrupted. One entry each:
/// name, what, threads, size, and
///   seconds, cpu_seconds, peak_memory  of the process [s], [s], [bytes]
///   solver_seconds, points, status, residual_rms, without_blemishes, exit_code  as summary.json says
///   or, of the interrupted one, to_exit_seconds
/// or "failed" or "skipped" with the reason. The time to make the map is not included. Starts none after `share` of the
/// budget.
nlohmann::json run_plans(const PlanRunOptions& options, const Budget& budget, double share, Measurements& measurements);

/// The program that is timed, as it was built.
std::filesystem::path dwell_program();

}  // namespace dwell::bench
