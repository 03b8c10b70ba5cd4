#pragma once

#include <vector>

#include "runs/tools/joint_problem.h"

namespace dwell::test {

/// A surface of 14 x 11 mm without symmetry, a corner missing, with waves of which only a small tool can take some.
HeightMap worked_surface();

/// A large tool, "large", and a small one, "small", at thrice its price a second, with rasters across each other.
std::vector<JointTool> two_tools(SolverKind solver, double small_peak = 4.0);

/// The least dwell of a tool's path [s].
Vector least_seconds(const JointTool& tool);

}  // namespace dwell::test
