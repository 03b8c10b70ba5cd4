#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dwell::bench {

/// A solver that is measured: one of the program's own catalogue, or a script of bench/peers.
struct BenchSolver {
  std::string name;
  bool peer = false;
  std::filesystem::path script;   // empty: of the catalogue
  std::optional<double> largest;  // dwell points that it takes at most; nothing = as many as there are
  bool needs_pixels = false;      // what limits it is a matrix of pixels x points, not of points x points
};

/// All of them, in the order of their turns: what a budget cuts off is what matters least.
const std::vector<BenchSolver>& bench_solvers();
/// Throws InputError naming the accepted words.
const BenchSolver& find_bench_solver(const std::string& name);

/// The Python that runs the scripts: the system's own, whose packages `./dev bench` installs.
inline constexpr const char* kPython = "/usr/bin/python3";
/// Why the scripts cannot be run on this machine; nothing if they can.
std::optional<std::string> why_no_scripts();

}  // namespace dwell::bench
