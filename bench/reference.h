#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include "bench/scenario.h"
#include "bench/solve_run.h"

namespace dwell::bench {

/// A reference is settled when its objective is proven to be above the optimum by no more than this share
/// (solvers/problem/lower_bound.h) ...
inline constexpr double kProvenShare = 1e-5;
/// ... or, where that is not reached in time, when twice the work lowers it by no more than this share.
inline constexpr double kSettledChange = 1e-6;

/// Solves a scenario as far as that, and returns the objective with its birth certificate: the weights and how they
/// were found, solver, options, iterations, certificate, commit, date. "settled" says whether it is settled, "by" by
/// which rule, "proven_share" what is proven and "change_when_doubled" what twice the work changed (null where that
/// was not tried). `weights`: the frozen ones; nothing = those that the program finds by default. Throws
/// std::runtime_error if the solver fails. `max_seconds` is for each of the two rules.
nlohmann::json make_reference(const Scenario& scenario, const std::optional<ScenarioWeights>& weights, int threads,
                              double max_seconds);

/// The cached references, keyed by the scenario's name; an empty object if there is no such file. Throws InputError
/// naming the file if it is not JSON.
nlohmann::json read_references(const std::filesystem::path& file);

/// The frozen weights of a scenario; none if the file has no entry of it.
std::optional<ScenarioWeights> weights_of(const nlohmann::json& references, const Scenario& scenario);
/// The same for a solve, which needs them. Throws InputError naming the command that makes them.
ScenarioWeights required_weights(const nlohmann::json& references, const Scenario& scenario);

/// The target in a cache of references; none if the scenario has no entry.
std::optional<Target> target_of(const nlohmann::json& references, const Scenario& scenario);

/// A reference in words, one line.
std::string reference_in_words(const nlohmann::json& reference);

}  // namespace dwell::bench
