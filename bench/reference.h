#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include "bench/scenario.h"
#include "bench/solve_run.h"

namespace dwell::bench {

/// Solves a scenario until twice the work lowers the objective by less than 1e-6 of itself, and returns that objective
/// with its birth certificate: solver, options, iterations, both objectives, certificate, commit, date. "settled" says
/// whether that was reached before `max_seconds`. Throws std::runtime_error if the solver fails.
nlohmann::json make_reference(const Scenario& scenario, SolverKind kind, int threads, double max_seconds);

/// The cached references, keyed by the scenario's name; an empty object if there is no such file.
nlohmann::json read_references(const std::filesystem::path& file);

/// The target in a cache of references; none if the scenario has no entry or its constants have changed since.
std::optional<Target> target_of(const nlohmann::json& references, const Scenario& scenario);

}  // namespace dwell::bench
