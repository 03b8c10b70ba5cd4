#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "bench/budget.h"
#include "bench/extent.h"
#include "bench/measurements.h"

namespace dwell::bench {

struct SuiteOptions {
  Extent extent = Extent::Default;     // Quick: the smallest scenarios, one round
  std::vector<std::string> scenarios;  // names; empty = all
  std::vector<std::string> solvers;    // names; empty = all; `auto` always
  std::filesystem::path data;
  std::filesystem::path references;
};

/// Runs every solver on every scenario, each solve in a process of its own. `auto` is first on each, on two threads and
/// on one, in all its rounds; the median of its times to within 1 % of the reference sets the limit of the others
/// (bench/peer_limit.h), which run on two threads. Who does not come within 1 % in its first round, or takes over 20 s,
/// is not run again: the result stands. A full run goes from scenario to scenario; one with a budget takes first what
/// matters most, the first turns of the fastest solvers on all of them. The result has one entry for each scenario,
/// solver and number of threads:
///   objective, residual   for 10 %, 1 % and 0.1 %: operator applications, coarse_pairs, median seconds, fastest,
///                         slowest; null where it was not reached
///   whole                 the same of the whole solve
///   times_given           the time limit over the time of `auto` to 1 %, for the others
/// and the result of the first run, with its trace; "refused", "failed", "late" or "too_large" with the reason where
/// there was no answer; "skipped" where there was no time for it or what it
/// needs is not installed.
nlohmann::json run_suite(const SuiteOptions& options, const Budget& budget, Measurements& measurements);

}  // namespace dwell::bench
