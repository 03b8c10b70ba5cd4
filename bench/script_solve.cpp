#include "bench/script_solve.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "bench/child.h"
#include "bench/json_access.h"
#include "bench/scratch_folder.h"
#include "bench/script_problem.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "solvers/problem/certificate.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr double kSameObjective = 1e-6;

/// Columns of a script's trace.
enum Column : Index { kSeconds, kObjective, kResidual, kApplications, kColumns };

/// The first line of the trace at which a column is within `share` of the target's.
Json reached_within(const Eigen::MatrixXd& trace, Column column, double target, double share) {
  for (Index i = 0; i < trace.rows(); ++i) {
    if (!(trace(i, column) <= (1.0 + share) * target)) continue;
    return {{"iterations", i},
            {"applications", trace(i, kApplications)},
            {"coarse_pairs", 0.0},
            {"seconds", trace(i, kSeconds)}};
  }
  return {};
}

Json read_end(const std::filesystem::path& file) {
  try {
    Json end = Json::parse(read_whole_file(file));
    for (const char* key : {"status", "message", "seconds", "applications"}) end.at(key);
    if (!std::isfinite(number(end, "seconds"))) throw InputError(file.string() + ": seconds is not a finite number");
    return end;
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: not the end of a script's answer: {}", file.string(), e.what()));
  }
}

}  // namespace

void read_script_answer(const std::filesystem::path& folder, const DwellProblem& problem, const SolveOptions& options,
                        Json& result) {
  const Json end = read_end(folder / "end.json");
  const Eigen::MatrixXd row = read_script_array(folder / "answer.npy", 1, problem.points());
  const Vector t = row.row(0).transpose();
  if (((t - problem.lower).array() < 0.0).any())
    throw InputError(fmt::format("{}: a dwell below the least; accepted: none", (folder / "answer.npy").string()));
  const Eigen::MatrixXd trace = read_script_array(folder / "trace.npy", -1, kColumns);
  const Certificate c = certify(problem, t);
  const double said = trace(trace.rows() - 1, kObjective);
  if (!(std::abs(said - c.objective) <= kSameObjective * c.objective)) {
    throw InputError(fmt::format("{}: the script says an objective of {:.9g} nm^2, its dwell has {:.9g}",
                                 (folder / "trace.npy").string(), said, c.objective));
  }
  Json lines = Json::array();
  for (Index i = 0; i < trace.rows(); ++i)
    lines.push_back({trace(i, kSeconds), trace(i, kApplications), trace(i, kObjective), trace(i, kResidual)});
  for (const double share : kQualities) {
    const auto within = [&](Column column, double target) {
      return options.target ? reached_within(trace, column, target, share) : Json();
    };
    result["reached"]["objective"].push_back(within(kObjective, options.target ? options.target->objective : 0.0));
    result["reached"]["residual"].push_back(within(kResidual, options.target ? options.target->residual_rms : 0.0));
  }
  const bool ended_alone = text_of(end, "status") == "stopped by itself";
  result.update({{"trace", lines},
                 {"status", ended_alone ? "stalled" : text_of(end, "status")},
                 {"message", end.at("message")},
                 {"iterations", trace.rows() - 1},
                 {"applications", end.at("applications")},
                 {"coarse_pairs", 0.0},
                 {"seconds", end.at("seconds")},
                 {"total_dwell", t.sum()},
                 {"step_rms", step_rms(problem, t)},
                 {"certificate",
                  {{"objective", c.objective},
                   {"residual_rms", c.residual_rms},
                   {"bound_violation", c.bound_violation},
                   {"projected_gradient", c.projected_gradient},
                   {"dual_infeasibility", c.dual_infeasibility},
                   {"complementarity", c.complementarity}}}});
}

Json solve_by_script(const Scenario& scenario, const BenchSolver& solver, const SolveOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Instance instance = make_instance(scenario, options.threads);
  set_weights(instance, options.weights);
  const DwellProblem& problem = instance.problem;
  Json result{{"scenario", scenario.name},         {"solver", solver.name},      {"threads", options.threads},
              {"points", problem.points()},        {"pixels", problem.pixels()}, {"operator", "Python"},
              {"max_seconds", options.max_seconds}};
  const ScratchFolder scratch;
  ScriptLimits limits;
  limits.max_seconds = options.max_seconds;
  limits.threads = options.threads;
  if (options.target && options.stop_at_target)
    limits.target_objective = (1.0 + options.stop_gap) * options.target->objective;
  if (options.target) {
    limits.scale_of_total = options.target->total_dwell;
    limits.scale_of_objective = options.target->objective;
  }
  write_script_problem(instance, limits, scratch.path());
  result["pair_seconds"] = seconds_of_a_pair(*instance.removal);
  result["build_seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  // Python starts and puts its operator together before its clock starts; what no clock reaches is ended after that.
  constexpr double kSetup = 60.0, kSetupAPoint = 3e-4;
  const double limit = kSetup + kSetupAPoint * static_cast<double>(problem.points()) + 4.0 * options.max_seconds;
  const std::filesystem::path words = scratch.path() / "words.txt";
  const ChildRun child = run_program(kPython, {"-B", solver.script.string(), scratch.path().string()},
                                     {options.threads, limit, words, false});
  if (child.end == ChildEnd::Done) {
    try {
      read_script_answer(scratch.path(), problem, options, result);
    } catch (const InputError& e) {
      result["failed"] = e.what();
    }
  } else if (child.end == ChildEnd::Killed && std::filesystem::exists(scratch.path() / "ready")) {
    result["late"] = "ended, as it did not look at the clock";
  } else {
    result["failed"] = fmt::format("{}: {}", solver.script.filename().string(), last_line_of(words));
  }
  return result;
}

}  // namespace dwell::bench
