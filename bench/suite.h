#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "bench/budget.h"

namespace dwell::bench {

struct SuiteOptions {
  bool quick = false;                  // the smallest scenarios, one round, short time limits
  std::vector<std::string> scenarios;  // names; empty = all
  std::filesystem::path data;
  std::filesystem::path references;
};

/// Runs every solver on every scenario, each solve in a process of its own, in interleaved rounds: `auto` first, on two
/// threads and on one, then the others on two. Then the solvers that came within 0.1 % of the reference run again, on
/// two threads and on one, until the rounds or the budget are used up. The result has one entry for each scenario,
/// solver and number of threads:
///   objective, residual   for 10 %, 1 % and 0.1 %: operator applications, coarse_pairs, median seconds, fastest,
///   slowest; null where
///                         it was not reached, with "limit" the seconds allowed
///   whole                 the same of the whole solve
///   and the result of solve_once for the first run, with its trace; "refused" or "killed" where there was no answer;
///   "skipped" where there was no time for it.
nlohmann::json run_suite(const SuiteOptions& options, const Budget& budget);

}  // namespace dwell::bench
