#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// What is known of a solver. One table of these records feeds the factory, the command line's words, the help, the
/// benchmark's list of peers and the tests that run over all solvers: a new solver is its two files, its value of
/// SolverKind and its row.
struct SolverRecord {
  SolverKind kind;
  std::string name;   // as a user writes it: "projected-cg"
  std::string about;  // one line: what it is
  /// Whether it is somebody else's solver or a textbook's method, run for comparison.
  bool peer = false;
  /// Dwell points that it takes at most; nothing = as many as there are. More are refused when it is run.
  std::optional<Index> largest;
  std::unique_ptr<DwellSolver> (*make)(const SolverOptions&);
};

/// Every solver in the order of a benchmark's turns, so that what a budget cuts off is what matters least: the default,
/// the peers that are fastest on most problems, the others.
const std::vector<SolverRecord>& solver_catalogue();
/// The record of a kind. Throws std::logic_error for a value of SolverKind that has none.
const SolverRecord& solver_record(SolverKind kind);

std::string to_string(SolverKind kind);
/// Throws InputError naming the accepted words.
SolverKind parse_solver_kind(const std::string& text);

/// Throws InputError for options that are out of range.
std::unique_ptr<DwellSolver> make_solver(const SolverOptions& options);

}  // namespace dwell
