#include "bench/solve_run.h"

#include <malloc.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/errors.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// A field of /proc/self/status [bytes]; 0 where there is none.
double memory_field(const std::string& name) {
  std::ifstream stream("/proc/self/status");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(name + ":")) return 1024.0 * std::stod(line.substr(name.size() + 1));
  }
  return 0.0;
}

/// Gives back what is free and makes the kernel forget the peak so far.
void reset_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// Watches a solve through its trace.
class Watch {
 public:
  Watch(const RemovalOperator& removal, const SolveOptions& options)
      : removal_(removal), options_(options), before_(removal.applications()) {}

  void see(const SolverProgress& p) { see(p, removal_.applications() - before_, since(begin_)); }

  void see(const SolverProgress& p, long applications, double seconds) {
    if (options_.target) {
      for (std::size_t q = 0; q < std::size(kQualities); ++q) {
        note(objective_[q], p.objective <= (1.0 + kQualities[q]) * options_.target->objective, p, applications,
             seconds);
        note(residual_[q], p.residual_rms <= (1.0 + kQualities[q]) * options_.target->residual_rms, p, applications,
             seconds);
      }
    }
    if (!(p.objective > 0.999 * last_)) {
      trace_.push_back({seconds, applications, p.objective, p.residual_rms});
      last_ = p.objective;
    }
    at_target_ = options_.stop_at_target && options_.target &&
                 p.objective <= (1.0 + options_.stop_gap) * options_.target->objective;
  }
  /// Whether the last objective seen was good enough to stop.
  bool at_target() const { return at_target_; }

  nlohmann::json trace() const { return trace_; }
  nlohmann::json reached() const {
    nlohmann::json all;
    for (std::size_t q = 0; q < std::size(kQualities); ++q) {
      all["objective"].push_back(objective_[q]);
      all["residual"].push_back(residual_[q]);
    }
    return all;
  }

 private:
  static void note(nlohmann::json& slot, bool reached, const SolverProgress& p, long applications, double seconds) {
    if (!reached || !slot.is_null()) return;
    slot = {{"iterations", p.iterations},
            {"applications", applications},
            {"coarse_pairs", p.coarse_pairs},
            {"seconds", seconds}};
  }

  const RemovalOperator& removal_;
  const SolveOptions& options_;
  long before_;
  Clock::time_point begin_ = Clock::now();
  std::array<nlohmann::json, std::size(kQualities)> objective_, residual_;
  nlohmann::json trace_ = nlohmann::json::array();
  double last_ = std::numeric_limits<double>::infinity();
  bool at_target_ = false;
};

/// Raises SIGALRM after so many seconds, unless the process that started this one has set an earlier alarm.
void end_process_after(double seconds) {
  const auto wanted = static_cast<unsigned>(std::ceil(seconds));
  const unsigned before = alarm(wanted);
  if (before != 0 && before < wanted) alarm(before);
}

void describe_end(nlohmann::json& result, const SolverSummary& s, const DwellProblem& problem, const Vector& t) {
  const Certificate c = certify(problem, t);
  result["status"] = s.status == SolverStatus::Interrupted ? "target reached" : to_string(s.status);
  result["message"] = s.message;
  result["iterations"] = s.iterations;
  result["applications"] = s.operator_applications;
  result["coarse_pairs"] = s.coarse_pairs;
  result["seconds"] = s.seconds;
  result["total_dwell"] = t.sum();
  result["step_rms"] = step_rms(problem, t);
  result["certificate"] = {{"objective", c.objective},
                           {"residual_rms", c.residual_rms},
                           {"bound_violation", c.bound_violation},
                           {"projected_gradient", c.projected_gradient},
                           {"dual_infeasibility", c.dual_infeasibility},
                           {"complementarity", c.complementarity}};
}

}  // namespace

double seconds_of_a_pair(RemovalOperator& removal) {
  Vector t = Vector::Ones(removal.cols()), r;
  removal.apply(t, r);
  removal.apply_adjoint(r, t);
  double fastest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5; ++k) {
    t.setOnes();
    const auto begin = Clock::now();
    removal.apply(t, r);
    removal.apply_adjoint(r, t);
    fastest = std::min(fastest, since(begin));
  }
  return fastest;
}

nlohmann::json solve_once(const Scenario& scenario, const SolveOptions& options) {
  omp_set_num_threads(options.threads);
  const auto begin = Clock::now();
  Instance instance = make_instance(scenario, options.threads);
  set_weights(instance, options.weights);
  nlohmann::json result{{"scenario", scenario.name},           {"solver", to_string(options.kind)},
                        {"threads", options.threads},          {"points", instance.problem.points()},
                        {"pixels", instance.problem.pixels()}, {"operator", instance.removal->name()},
                        {"build_seconds", since(begin)}};
  const double pair = seconds_of_a_pair(*instance.removal);
  result["pair_seconds"] = pair;

  SolverOptions solver;
  solver.kind = options.kind;
  solver.objective_tolerance = 0.0;
  solver.max_iterations = 1'000'000;
  solver.gradient_tolerance = options.gradient_tolerance;
  solver.max_seconds = options.max_seconds;
  result["max_seconds"] = solver.max_seconds;
  // Not every solver looks at the clock often enough, so the signal ends the process.
  end_process_after(2.0 * solver.max_seconds + 3.0);
  reset_peak_memory();
  const double held = memory_field("VmRSS");
  Vector t;
  try {
    Watch watch(*instance.removal, options);
    solver.trace = [&](const SolverProgress& p) { watch.see(p); };
    solver.progress.stop = [&] { return watch.at_target(); };
    const SolverSummary s = make_solver(solver)->solve(instance.problem, t);
    // The final answer counts as well, because not every solver reports on its way.
    result["peak_memory"] = memory_field("VmHWM");
    result["solve_memory"] = memory_field("VmHWM") - held;
    const double rms = certify(instance.problem, t).residual_rms;
    watch.see({s.iterations, s.coarse_pairs, s.seconds, s.objective, rms}, s.operator_applications, s.seconds);
    result["reached"] = watch.reached();
    result["trace"] = watch.trace();
    describe_end(result, s, instance.problem, t);
  } catch (const InputError& e) {
    result["refused"] = e.what();
  }
  return result;
}

}  // namespace dwell::bench
