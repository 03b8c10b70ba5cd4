#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "bench/budget.h"
#include "bench/extent.h"
#include "bench/measurements.h"

namespace dwell::bench {

struct CertificateRunOptions {
  Extent extent = Extent::Default;  // Quick: short time limits
  std::string scenario;
  std::filesystem::path data;
  std::filesystem::path references;
};

/// Solves the scenario to the certificates 1e-3, 1e-4, 1e-5 and 1e-6 of the projected gradient, each from the lower
/// bound in a process of its own, by `auto` and for comparison by `projected-cg`, on two threads. A solver that misses
/// one is not asked for the next. One entry a solve: the result of solve_once, and
///   "tolerance", and "certified": whether certify(), which trusts no solver, finds the projected gradient within it
/// or "skipped" with the reason. Starts no solve that may end after `share` of the budget.
nlohmann::json run_certificates(const CertificateRunOptions& options, const Budget& budget, double share,
                                Measurements& measurements);

}  // namespace dwell::bench
