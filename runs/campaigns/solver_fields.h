#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// The fields of a solver's summary that a part holds (runs/base/exact_json.h): all.
template <class Visit>
void each_field(SolverSummary& s, const Visit& visit) {
  visit("kind", s.kind), visit("status", s.status), visit("iterations", s.iterations);
  visit("operator_applications", s.operator_applications), visit("coarse_pairs", s.coarse_pairs);
  visit("wall_s", s.seconds), visit("objective", s.objective), visit("message", s.message);
}

}  // namespace dwell
