#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace dwell::bench {

using Json = nlohmann::json;

inline Json reached(double applications, double seconds) {
  const Json slot{{"iterations", 1},    {"applications", applications}, {"coarse_pairs", 15.0},
                  {"seconds", seconds}, {"fastest", seconds},           {"slowest", seconds}};
  return {{"objective", {slot, slot, slot}}, {"residual", {slot, slot, slot}}};
}

/// A line of the suite that arrived: 20 applications and 2 s to every quality, 4 s in all.
inline Json solve(const std::string& scenario, const std::string& solver, int threads) {
  return {{"scenario", scenario},
          {"solver", solver},
          {"threads", threads},
          {"rounds", 1},
          {"points", 20000},
          {"pixels", 1048576},
          {"operator", "lattice"},
          {"pair_seconds", 0.1},
          {"build_seconds", 1.0},
          {"max_seconds", 30.0},
          {"seconds", 4.0},
          {"applications", 20},
          {"coarse_pairs", 15.0},
          {"solve_memory", 8.0 * 1048576 * 10.0},
          {"total_dwell", 400.0},
          {"step_rms", 0.003},
          {"status", "target reached"},
          {"certificate", {{"objective", 1.0}, {"residual_rms", 0.15}, {"projected_gradient", 1e-3}}},
          {"whole", {{"seconds", 4.0}, {"fastest", 4.0}, {"slowest", 4.0}}},
          {"reached", reached(20, 2.0)}};
}

inline Json scenario(const std::string& name) {
  return {{"name", name},
          {"what", "made for a test"},
          {"lattice", true},
          {"reference",
           {{"objective", 1.0},
            {"residual_rms", 0.15},
            {"total_dwell", 400.0},
            {"smoothness", 0.1},
            {"time_price", 1e-4},
            {"weights_from", "auto, price by the rule share"},
            {"proven_share", 1e-6},
            {"change_when_doubled", nullptr},
            {"by", "proven"},
            {"settled", true}}}};
}

inline Json never(Json run, const std::string& status) {
  run["status"] = status;
  for (const char* what : {"objective", "residual"}) run["reached"][what] = {nullptr, nullptr, nullptr};
  return run;
}

inline Json results(const std::vector<Json>& runs) {
  Json all{{"results", runs}, {"scenarios", Json::array()}};
  std::vector<std::string> seen;
  for (const Json& run : runs) {
    if (std::find(seen.begin(), seen.end(), run["scenario"]) != seen.end()) continue;
    seen.push_back(run["scenario"]);
    all["scenarios"].push_back(scenario(run["scenario"]));
  }
  return all;
}

}  // namespace dwell::bench
