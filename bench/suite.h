#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "solvers/dwell_solver.h"

namespace dwell::bench {

struct SuiteOptions {
  bool quick = false;                  // the smallest scenario, one round
  std::vector<std::string> scenarios;  // names; empty = all
  int rounds = 3;
  double budget = 600.0;  // no run is started later than this [s]
  std::filesystem::path data;
  std::filesystem::path references;
};

/// Somebody else's method, or an oracle: measured where its size allows, and left out where a scenario has no peers.
bool is_peer(SolverKind kind);

/// Runs every solver on every scenario, each in a process of its own, in interleaved rounds: all of them once on two
/// threads, then those that came within 0.1 % of the reference on one and on two threads again, until the rounds or the
/// budget are used up. The result has one entry a scenario, solver and number of threads:
///   objective, residual   for 10 %, 1 % and 0.1 %: operator applications, median seconds, fastest, slowest; null where
///                         it was not reached, with "limit" the seconds allowed
///   and what solve_once tells of the first run, its trace included; "refused" or "killed" where there was no answer.
nlohmann::json run_suite(const SuiteOptions& options);

}  // namespace dwell::bench
