#include "solvers/weights/nlopt_search.h"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

namespace dwell {
namespace {

struct Destroy {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};

struct Callback {
  const FewVariableProblem& problem;
  nlopt_opt optimiser;
  std::vector<double> x;  // last evaluated; empty before the first
  double objective = 0.0;
  bool ended = false;
  std::exception_ptr thrown;

  void evaluate_at(unsigned n, const double* at) {
    std::vector<double> asked(at, at + n);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      asked[i] = std::clamp(asked[i], problem.lower[i], problem.upper[i]);
    }
    if (ended || asked == x) return;
    x = std::move(asked);
    try {
      ended = !problem.evaluate(x, objective);
    } catch (...) {  // NLopt is C: nothing may be thrown through it
      thrown = std::current_exception();
      ended = true;
    }
    if (ended) nlopt_force_stop(optimiser);
  }
};

double objective_at(unsigned n, const double* x, double*, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  callback.evaluate_at(n, x);
  return callback.objective;
}

}  // namespace

void search_few_variables(const FewVariableProblem& problem) {
  const std::size_t n = problem.start.size();
  if (n == 0 || problem.lower.size() != n || problem.upper.size() != n || problem.first_step.size() != n) {
    throw std::invalid_argument("start, lower, upper and first_step of a search differ in size or are empty");
  }
  const std::unique_ptr<std::remove_pointer_t<nlopt_opt>, Destroy> owned(
      nlopt_create(NLOPT_LN_COBYLA, static_cast<unsigned>(n)));
  if (!owned) throw std::bad_alloc();
  nlopt_opt optimiser = owned.get();
  Callback callback{problem, optimiser, {}, 0.0, false, {}};
  nlopt_set_lower_bounds(optimiser, problem.lower.data());
  nlopt_set_upper_bounds(optimiser, problem.upper.data());
  nlopt_set_min_objective(optimiser, objective_at, &callback);
  nlopt_set_initial_step(optimiser, problem.first_step.data());
  nlopt_set_xtol_abs1(optimiser, problem.tolerance);
  nlopt_set_maxeval(optimiser, problem.max_evaluations);
  std::vector<double> x = problem.start;
  double value = 0.0;
  nlopt_optimize(optimiser, x.data(), &value);  // how it ended does not matter: the caller has seen every evaluation
  if (callback.thrown) std::rethrow_exception(callback.thrown);
}

}  // namespace dwell
