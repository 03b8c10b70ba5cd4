#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace dwell::bench {

/// One solve in a process of its own: `dwell-bench solve` and its options.
struct SolveRequest {
  std::string scenario;
  std::string solver = "auto";
  int threads = 2;
  double max_seconds = 60.0;  // for the solve alone
  double wall_limit = 0.0;    // for the whole process, making the instance included; 0 = none [s]
  double stop_gap = 1e-4;
  bool to_certificate = false;
  double gradient_tolerance = 1e-6;
  std::filesystem::path data;
  std::filesystem::path references;
};

/// The result of solve_once or solve_by_script; or why there is none: "late" if a solver that does not look at the
/// clock was ended after its time limit, "failed". And "max_seconds" and "process_seconds", the wall clock of the whole
/// process.
nlohmann::json solve_in_child(const SolveRequest& request);

}  // namespace dwell::bench
