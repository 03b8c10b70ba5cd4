#include "bench/solver_list.h"

#include <fmt/format.h>

#include "bench/child.h"
#include "core/base/errors.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

/// A matrix of so many dwell points squared is what scipy.optimize.nnls can be given on a machine of 16 GiB: the
/// normal equations, their factor and the copy that it works on.
constexpr double kMostNnlsPoints = 20'000.0;

std::vector<BenchSolver> make_list() {
  const std::filesystem::path folder = DWELL_BENCH_PEERS;
  std::vector<BenchSolver> all;
  for (const SolverRecord& r : solver_catalogue()) {
    BenchSolver solver{r.name, r.peer, {}, std::nullopt, r.kind == SolverKind::Ceres};
    if (r.largest) solver.largest = static_cast<double>(*r.largest);
    all.push_back(solver);
    if (r.kind != SolverKind::Lbfgsb) continue;
    all.push_back({"scipy-lbfgsb", true, folder / "scipy_lbfgsb.py", {}, false});
    all.push_back({"scipy-lsq-linear", true, folder / "scipy_lsq_linear.py", {}, false});
    all.push_back({"scipy-nnls", true, folder / "scipy_nnls.py", kMostNnlsPoints, false});
  }
  return all;
}

}  // namespace

const std::vector<BenchSolver>& bench_solvers() {
  static const std::vector<BenchSolver> kAll = make_list();
  return kAll;
}

const BenchSolver& find_bench_solver(const std::string& name) {
  std::string accepted;
  for (const BenchSolver& solver : bench_solvers()) {
    if (solver.name == name) return solver;
    accepted += (accepted.empty() ? "" : ", ") + solver.name;
  }
  throw InputError(fmt::format("--solver = '{}'; accepted: {}", name, accepted));
}

std::optional<std::string> why_no_scripts() {
  if (!std::filesystem::exists(kPython)) return fmt::format("{} is missing (Debian: python3)", kPython);
  const ChildRun run = run_program(kPython, {"-c", "import numpy, scipy.optimize"}, {1, 60.0, "/dev/null", false});
  if (run.end != ChildEnd::Done)
    return fmt::format("{} does not import NumPy and SciPy (Debian: python3-numpy, python3-scipy)", kPython);
  return std::nullopt;
}

}  // namespace dwell::bench
