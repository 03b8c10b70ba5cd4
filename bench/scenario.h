#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_kernel.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell::bench {

/// What a scenario consists of, before its operator is made.
struct Parts {
  HeightMap map;
  RemovalFunction tif;
  ToolPath path;
  bool moving = false;  // the tool runs through its points; else it halts at each
  double least = 0.0;   // lower bound of every dwell time [s]
};

/// A fixed dwell problem that all solvers are measured on. Piston and tilt are projected out. Two terms make it well
/// posed (on an ill-posed problem there is no time to a quality, because the residual falls for ever while the dwell
/// grows):
///   alpha = smoothness * (sum of squared samples of the removal function)
///   gamma = price * (RMS of the target) * (sum of the samples of the removal function)
/// that is, a second is worth spending as long as the tool sits on more than `price` of the RMS.
struct Scenario {
  std::string name;
  std::string what;
  bool quick = false;     // is part of --quick
  bool peers = true;      // false: too large for any solver but the native ones
  double pairs = 400.0;   // time limit of a solve, in operator pairs at its number of threads
  double patience = 2.0;  // but at least so many seconds for L-BFGS-B, the peer that is first nearly everywhere
  double smoothness = 0.1;
  double price = 1e-4;
  std::function<Parts()> make;
};

/// Throws InputError naming the known ones.
const Scenario& find_scenario(const std::vector<Scenario>& all, const std::string& name);

/// A scenario ready to be solved.
struct Instance {
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;  // refers to `removal`
};
Instance make_instance(const Scenario& scenario, int threads);

}  // namespace dwell::bench
