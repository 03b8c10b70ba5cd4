#include "solvers/peers/nlopt_solver.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <memory>
#include <stdexcept>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "solvers/peers/adapter_run.h"

namespace dwell {
namespace {

nlopt_algorithm algorithm_of(SolverKind kind) {
  switch (kind) {
    case SolverKind::NloptLbfgs:
      return NLOPT_LD_LBFGS;
    case SolverKind::NloptMma:
      return NLOPT_LD_MMA;
    case SolverKind::NloptTnewton:
      return NLOPT_LD_TNEWTON_PRECOND_RESTART;
    case SolverKind::NloptSlsqp:
      return NLOPT_LD_SLSQP;
    default:
      throw std::logic_error("this kind of solver is not a method of NLopt");
  }
}

/// What NLopt's callback needs: x of NLopt is (t - l) / unit, its objective f / value_unit.
struct Evaluation {
  AdapterRun& run;
  const DwellProblem& problem;
  nlopt_opt optimiser;
  double unit;
  double value_unit = 0.0;  // 0: not known before the first evaluation
  Vector t, gradient;
};

double evaluate(unsigned n, const double* x, double* gradient, void* data) {
  auto& e = *static_cast<Evaluation*>(data);
  e.t = e.problem.lower + e.unit * Eigen::Map<const Vector>(x, n);
  const double value = e.run.evaluate(e.t, e.gradient);
  if (e.value_unit == 0.0) e.value_unit = value > 0.0 ? value : 1.0;
  if (gradient) Eigen::Map<Vector>(gradient, n) = (e.unit / e.value_unit) * e.gradient;
  if (e.run.stopped()) nlopt_force_stop(e.optimiser);
  return value / e.value_unit;
}

struct Destroy {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};

}  // namespace

void NloptSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  const Index n = problem.points();
  if (options_.kind == SolverKind::NloptSlsqp && n > kMaxSlsqpPoints) {
    throw InputError(fmt::format("solver = 'nlopt-slsqp' with {}; accepted: at most {}", counted(n, "dwell point"),
                                 kMaxSlsqpPoints));
  }
  AdapterRun run(problem, options_, t, summary);
  std::string reason = "no dwell points";
  if (!run.stopped() && n > 0) {
    const std::unique_ptr<std::remove_pointer_t<nlopt_opt>, Destroy> optimiser(
        nlopt_create(algorithm_of(options_.kind), static_cast<unsigned>(n)));
    if (!optimiser) throw std::bad_alloc();
    Evaluation e{run, problem, optimiser.get(), run.dwell_scale(t), 0.0, {}, {}};
    nlopt_set_min_objective(optimiser.get(), evaluate, &e);
    nlopt_set_lower_bounds1(optimiser.get(), 0.0);
    if (problem.upper.size() != 0) {
      const Vector upper = (problem.upper - problem.lower) / e.unit;
      nlopt_set_upper_bounds(optimiser.get(), upper.data());
    }
    Vector x = (t - problem.lower) / e.unit;
    double value = 0.0;
    const nlopt_result result = nlopt_optimize(optimiser.get(), x.data(), &value);
    const char* words = nlopt_get_errmsg(optimiser.get());
    reason =
        fmt::format("NLopt ended with {}{}{}", nlopt_result_to_string(result), words ? ": " : "", words ? words : "");
  }
  run.finish(reason, t);
}

}  // namespace dwell
