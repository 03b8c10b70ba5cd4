#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

#include "bench/scenario.h"
#include "bench/solve_run.h"
#include "bench/solver_list.h"

namespace dwell::bench {

/// Solves a scenario with a script of bench/peers. The time is that of its solve alone, without the start of Python,
/// its imports and the setup of its operator. The result is that of solve_once, but for memory; "late" where the script
/// was ended after its time limit without an answer, "failed" with the reason where it did not work or its answer is
/// not what it says.
nlohmann::json solve_by_script(const Scenario& scenario, const BenchSolver& solver, const SolveOptions& options);

/// The answer of a script in `folder`, judged by the problem itself: that the dwell is as long as the problem and
/// within its bounds, and that the objective at it is what the script says (to 1e-6). Throws InputError naming the file
/// and what is not so. Adds reached, trace, certificate and what else solve_once says of an end to `result`.
void read_script_answer(const std::filesystem::path& folder, const DwellProblem& problem, const SolveOptions& options,
                        nlohmann::json& result);

}  // namespace dwell::bench
