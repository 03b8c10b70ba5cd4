#include "bench/faults.h"

#include <fmt/format.h>

#include "bench/json_access.h"
#include "bench/solve_run.h"
#include "bench/solver_list.h"
#include "bench/solver_tables.h"

namespace dwell::bench {

namespace {

constexpr double kFewPoints = 1e3;

}  // namespace

std::vector<std::string> faults_of(const nlohmann::json& all) {
  std::vector<std::string> faults;
  for (const nlohmann::json& scenario : list_of(all, "scenarios")) {
    const std::string name = text_of(scenario, "name");
    if (scenario.at("reference").is_null() || !scenario.at("reference").at("settled").get<bool>()) {
      faults.push_back(fmt::format("{}: no settled reference", name));
      continue;
    }
    const std::optional<Pairs> own = pairs_to(find_run(all, name, "auto", 2), kOnePercent);
    if (!own) {
      faults.push_back(fmt::format("{}: `auto` did not come within 1 % of the reference", name));
      continue;
    }
    for (const BenchSolver& solver : bench_solvers()) {
      if (!solver.peer) continue;
      const std::optional<Pairs> pairs = pairs_to(find_run(all, name, solver.name, 2), kOnePercent);
      const bool small = number(find_run(all, name, "auto", 2), "points") < kFewPoints;
      if (small || !pairs || !(pairs->total() < own->total())) continue;
      faults.push_back(fmt::format("{}: {} came within 1 % in {:.1f} operator pairs, `auto` in {:.1f}", name,
                                   solver.name, pairs->total(), own->total()));
    }
  }
  return faults;
}

}  // namespace dwell::bench
