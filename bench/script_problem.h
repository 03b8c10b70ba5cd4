#pragma once

#include <Eigen/Core>

#include <filesystem>

#include "bench/scenario.h"

namespace dwell::bench {

/// What a script is told besides the problem.
struct ScriptLimits {
  double max_seconds = 0.0;       // of its solve alone
  double target_objective = 0.0;  // it ends this close to it [nm^2]; 0 = none
  // The order of total dwell [s] and objective [nm^2] at the optimum, which a method may need to scale its rows.
  double scale_of_total = 0.0, scale_of_objective = 0.0;
  int threads = 1;
};

/// Writes a dwell problem into a folder, for scripts that share no code with this program: problem.json, and arrays in
/// NPY format of which bench/peers/problem.py says what they are. The removal is described by its parts, the kernel on
/// the lattice and where each stroke is spread on it; that a script has put them together right it can tell from
/// `check_dwell` and what the program's operator removes with it. Cost: one operator application.
void write_script_problem(Instance& instance, const ScriptLimits& limits, const std::filesystem::path& folder);

/// Reads a vector or matrix that a script has written ('<f8', two dimensions). Throws InputError naming the file and
/// what is not so: a size other than `rows` x `cols` (-1 = any), a number that is not finite.
Eigen::MatrixXd read_script_array(const std::filesystem::path& file, Index rows, Index cols);

}  // namespace dwell::bench
