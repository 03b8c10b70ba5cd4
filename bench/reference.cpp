#include "bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/machine.h"
#include "core/base/whole_file.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

constexpr double kChange = 1e-6;
// Operator pairs: more than the longest cycle in which a solver shows no gain. That of `auto` is a round.
constexpr double kFirstLook = 500.0;
constexpr double kFirstLookOfAuto = 30.0;
constexpr long kLeastIterations = 3;

}  // namespace

nlohmann::json make_reference(const Scenario& scenario, SolverKind kind, int threads, double max_seconds) {
  const Machine machine = this_machine();
  const Instance instance = make_instance(scenario, threads);
  SolverOptions options;
  options.kind = kind;
  options.gradient_tolerance = 1e-8;
  options.objective_tolerance = 0.0;
  options.max_iterations = 1'000'000;
  options.max_seconds = max_seconds;
  double look = kind == SolverKind::Auto ? kFirstLookOfAuto : kFirstLook, half_way = 0.0, change = 1.0;
  long iterations = 0;
  bool settled = false;
  options.progress.stop = [&] { return settled; };
  options.trace = [&](const SolverProgress& p) {
    const double work = static_cast<double>(p.iterations) + p.coarse_pairs;
    // Between two of its iterations, a solver on coarse pixels shows no gain.
    if (work < look || p.iterations < iterations + kLeastIterations) return;
    iterations = p.iterations;
    if (half_way > 0.0) change = (half_way - p.objective) / p.objective;
    settled = half_way > 0.0 && change <= kChange;
    half_way = p.objective;
    look = 2.0 * work;
  };
  Vector t;
  const SolverSummary s = make_solver(options)->solve(instance.problem, t);
  if (!s.usable()) throw std::runtime_error(fmt::format("{}: {}", scenario.name, s.message));
  const Certificate c = certify(instance.problem, t);
  return {{"objective", c.objective},
          {"residual_rms", c.residual_rms},
          {"total_dwell", t.sum()},
          {"projected_gradient", c.projected_gradient},
          {"settled", settled || s.status == SolverStatus::Converged},
          {"change_when_doubled", s.status == SolverStatus::Converged ? 0.0 : change},
          {"iterations", s.iterations},
          {"applications", s.operator_applications},
          {"status", s.message},
          {"solver", to_string(kind)},
          {"gradient_tolerance", options.gradient_tolerance},
          {"smoothness", scenario.smoothness},
          {"price", scenario.price},
          {"points", instance.problem.points()},
          {"pixels", instance.problem.pixels()},
          {"threads", threads},
          {"commit", machine.commit},
          {"compiler", machine.compiler},
          {"date", machine.date}};
}

nlohmann::json read_references(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return nlohmann::json::object();
  return nlohmann::json::parse(read_whole_file(file));
}

std::optional<Target> target_of(const nlohmann::json& references, const Scenario& scenario) {
  const auto found = references.find(scenario.name);
  if (found == references.end()) return std::nullopt;
  if (found->at("smoothness").get<double>() != scenario.smoothness ||
      found->at("price").get<double>() != scenario.price)
    return std::nullopt;
  return Target{found->at("objective").get<double>(), found->at("residual_rms").get<double>()};
}

}  // namespace dwell::bench
