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
  HeightMap whole;      // as measured, where `map` counts only a part of it; empty = map
};

/// What makes a dwell problem well posed, in the words of the program's options: on an ill-posed problem there is no
/// time to a quality, because the residual falls for ever while the dwell grows.
struct ScenarioWeights {
  double smoothness = 0.0;  // alpha = smoothness * (sum of squared samples of the removal function)
  double time_price = 0.0;  // gamma = time_price * pixels [nm^2/s]
};

/// A fixed dwell problem that all solvers are measured on. Piston and tilt are projected out. Its weights are those
/// that the program finds by default (`auto`), found once and frozen with the reference (bench/reference.h), so that
/// the problem does not change with the rules that find them.
struct Scenario {
  std::string name;
  std::string what;
  bool quick = false;    // is part of --quick
  bool lattice = false;  // every dwell point a halt on a pixel's centre, on a lattice of its own
  std::function<Parts()> make;
};

/// Throws InputError naming the known ones.
const Scenario& find_scenario(const std::vector<Scenario>& all, const std::string& name);

/// A scenario ready to be solved, but for its weights.
struct Instance {
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;           // refers to `removal`; weights 0
  Grid map;                       // whose pixels its geometry counts
  double energy = 0.0;            // sum of squared samples of the removal function [nm^2/s^2]
  double usual_smoothness = 0.0;  // that of --smoothness auto
};
Instance make_instance(const Scenario& scenario, int threads);

/// Sets the problem's alpha and gamma.
void set_weights(Instance& instance, const ScenarioWeights& weights);

/// The weights that the program finds by default: smoothness `auto` and the price of `auto` that belongs to it. Leaves
/// them set. Cost: that of find_time_price.
struct FoundWeights {
  ScenarioWeights weights;
  std::string price_rule;  // "share" or "average", which set the price
};
FoundWeights find_usual_weights(Instance& instance);

}  // namespace dwell::bench
