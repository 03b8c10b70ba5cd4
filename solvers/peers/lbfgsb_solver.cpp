#include "solvers/peers/lbfgsb_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "solvers/peers/adapter_run.h"

// The library comes without a header. Argument list: its README; the two lengths at the end are those of the strings,
// which gfortran passes hidden, as size_t, since version 8.
extern "C" void setulb_(const int* n, const int* m, double* x, const double* l, const double* u, const int* nbd,
                        double* f, double* g, const double* factr, const double* pgtol, double* wa, int* iwa,
                        char* task, const int* iprint, char* csave, int* lsave, int* isave, double* dsave,
                        std::size_t task_length, std::size_t csave_length);

namespace dwell {
namespace {

/// The state that the routine keeps with its caller between calls.
struct Workspace {
  explicit Workspace(int n, int m)
      : wa(static_cast<std::size_t>(2 * m + 5) * static_cast<std::size_t>(n) +
           static_cast<std::size_t>(11 * m * m + 8 * m)),
        iwa(3 * static_cast<std::size_t>(n)) {
    task.fill(' ');
    csave.fill(' ');
    std::copy_n("START", 5, task.begin());
  }
  bool asks_for(std::string_view what) const { return std::string_view(task.data(), task.size()).starts_with(what); }
  std::string words() const {
    const std::string_view all(task.data(), task.size());
    return std::string(all.substr(0, all.find_last_not_of(' ') + 1));
  }

  std::vector<double> wa;
  std::vector<int> iwa;
  std::array<char, 60> task{}, csave{};
  std::array<int, 4> lsave{};
  std::array<int, 44> isave{};
  std::array<double, 29> dsave{};
};

std::string minimise(AdapterRun& run, const DwellProblem& problem, const Vector& start) {
  const int n = static_cast<int>(problem.points()), m = LbfgsbSolver::kCorrections, silent = -1;
  const double off = 0.0;
  const double unit = run.dwell_scale(start);
  Vector x = (start - problem.lower) / unit, g(n), t, gradient;
  const Vector lower = Vector::Zero(n);
  Vector upper = Vector::Zero(n);
  std::vector<int> kinds(static_cast<std::size_t>(n), 1);  // 1: lower bound only, 2: both
  for (int j = 0; j < n; ++j) {
    if (!std::isfinite(problem.upper_at(j))) continue;
    kinds[static_cast<std::size_t>(j)] = 2;
    upper[j] = (problem.upper_at(j) - problem.lower[j]) / unit;
  }
  Workspace w(n, m);
  double f = 0.0, value_unit = 0.0;
  while (true) {
    setulb_(&n, &m, x.data(), lower.data(), upper.data(), kinds.data(), &f, g.data(), &off, &off, w.wa.data(),
            w.iwa.data(), w.task.data(), &silent, w.csave.data(), w.lsave.data(), w.isave.data(), w.dsave.data(),
            w.task.size(), w.csave.size());
    if (w.asks_for("NEW_X")) continue;
    if (!w.asks_for("FG")) return "L-BFGS-B ended with " + w.words();
    t = problem.lower + unit * x;
    f = run.evaluate(t, gradient);
    if (run.stopped()) return {};
    if (value_unit == 0.0) value_unit = f > 0.0 ? f : 1.0;
    f /= value_unit;
    g = (unit / value_unit) * gradient;
  }
}

}  // namespace

void LbfgsbSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  if (problem.points() > std::numeric_limits<int>::max() / 32) throw std::length_error("too many dwell points");
  AdapterRun run(problem, options_, t, summary);
  std::string reason = "no dwell points";
  if (!run.stopped() && problem.points() > 0) reason = minimise(run, problem, t);
  run.finish(reason, t);
}

}  // namespace dwell
