#include "bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/json_access.h"
#include "bench/machine.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "solvers/problem/certificate.h"
#include "solvers/proof.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

constexpr double kFirstLook = 30.0;  // operator pairs: more than a round of `auto`, in which it shows no gain
constexpr long kLeastIterations = 3;

struct Answer {
  Vector dwell;
  SolverSummary summary;
  Certificate certificate;
  double change_when_doubled = std::nan("");
};

SolverOptions strict_options(double max_seconds) {
  SolverOptions options;
  options.gradient_tolerance = 1e-5;
  options.objective_tolerance = 1e-4;
  options.max_iterations = 1'000'000;
  options.max_seconds = max_seconds;
  return options;
}

void check_usable(const Scenario& scenario, const SolverSummary& summary) {
  if (!summary.usable()) throw std::runtime_error(fmt::format("{}: {}", scenario.name, summary.message));
}

/// Solves until the objective is proven.
Answer proven_answer(const Scenario& scenario, const DwellProblem& problem, double max_seconds) {
  Answer answer;
  SolverOptions options = strict_options(max_seconds);
  answer.summary = make_solver(options)->solve(problem, answer.dwell);
  check_usable(scenario, answer.summary);
  answer.certificate = certify(problem, answer.dwell);
  options.max_seconds = std::max(1.0, max_seconds - answer.summary.seconds);
  prove_optimum(problem, options, kProvenShare, answer.dwell, answer.summary, answer.certificate);
  return answer;
}

/// Solves until twice the work changes nothing any more.
Answer doubled_answer(const Scenario& scenario, const DwellProblem& problem, double max_seconds) {
  Answer answer;
  SolverOptions options = strict_options(max_seconds);
  options.gradient_tolerance = 1e-8;
  options.objective_tolerance = 0.0;
  double look = kFirstLook, half_way = 0.0;
  long iterations = 0;
  bool settled = false;
  options.progress.stop = [&] { return settled; };
  options.trace = [&](const SolverProgress& p) {
    const double work = static_cast<double>(p.iterations) + p.coarse_pairs;
    // Between two of its iterations, a solver on coarse pixels shows no gain.
    if (work < look || p.iterations < iterations + kLeastIterations) return;
    iterations = p.iterations;
    if (half_way > 0.0) answer.change_when_doubled = (half_way - p.objective) / p.objective;
    settled = half_way > 0.0 && answer.change_when_doubled <= kSettledChange;
    half_way = p.objective;
    look = 2.0 * work;
  };
  answer.summary = make_solver(options)->solve(problem, answer.dwell);
  check_usable(scenario, answer.summary);
  if (answer.summary.status == SolverStatus::Converged) answer.change_when_doubled = 0.0;
  answer.certificate = certify(problem, answer.dwell);
  return answer;
}

std::string rule_of(const Answer& answer) {
  if (answer.certificate.gap() <= kProvenShare) return "proven";
  return answer.change_when_doubled <= kSettledChange ? "unchanged when doubled" : "none";
}

}  // namespace

nlohmann::json make_reference(const Scenario& scenario, const std::optional<ScenarioWeights>& weights, int threads,
                              double max_seconds) {
  const Computer machine = this_machine();
  Instance instance = make_instance(scenario, threads);
  nlohmann::json result;
  ScenarioWeights set;
  if (weights) {
    set = *weights;
    set_weights(instance, set);
    result["weights_from"] = "frozen";
  } else {
    const FoundWeights found = find_usual_weights(instance);
    set = found.weights;
    result["weights_from"] = "auto, price by the rule " + found.price_rule;
  }
  const DwellProblem& problem = instance.problem;
  Answer answer = proven_answer(scenario, problem, max_seconds);
  if (rule_of(answer) == "none") {
    Answer doubled = doubled_answer(scenario, problem, max_seconds);
    if (doubled.certificate.objective <= answer.certificate.objective) answer = std::move(doubled);
  }
  const Certificate& c = answer.certificate;
  result.update(
      {{"objective", c.objective},
       {"residual_rms", c.residual_rms},
       {"total_dwell", answer.dwell.sum()},
       {"step_rms", step_rms(problem, answer.dwell)},
       {"projected_gradient", c.projected_gradient},
       {"proven_share", std::isfinite(c.gap()) ? nlohmann::json(c.gap()) : nlohmann::json()},
       {"settled", rule_of(answer) != "none"},
       {"by", rule_of(answer)},
       {"change_when_doubled",
        std::isfinite(answer.change_when_doubled) ? nlohmann::json(answer.change_when_doubled) : nlohmann::json()},
       {"iterations", answer.summary.iterations},
       {"applications", answer.summary.operator_applications},
       {"status", answer.summary.message},
       {"solver", to_string(SolverKind::Auto)},
       {"smoothness", set.smoothness},
       {"time_price", set.time_price},
       {"points", problem.points()},
       {"pixels", problem.pixels()},
       {"threads", threads},
       {"commit", machine.commit},
       {"compiler", machine.compiler},
       {"date", machine.date}});
  return result;
}

nlohmann::json read_references(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return nlohmann::json::object();
  try {
    return nlohmann::json::parse(read_whole_file(file));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("{}: not a JSON file of references: {}", file.string(), e.what()));
  }
}

std::optional<ScenarioWeights> weights_of(const nlohmann::json& references, const Scenario& scenario) {
  const auto found = references.find(scenario.name);
  if (found == references.end()) return std::nullopt;
  return ScenarioWeights{number(*found, "smoothness"), number(*found, "time_price")};
}

ScenarioWeights required_weights(const nlohmann::json& references, const Scenario& scenario) {
  if (const auto weights = weights_of(references, scenario)) return *weights;
  throw InputError(
      fmt::format("scenario '{0}' has no weights in the references; to make them: ./dev bench reference "
                  "--scenario {0}",
                  scenario.name));
}

std::optional<Target> target_of(const nlohmann::json& references, const Scenario& scenario) {
  const auto found = references.find(scenario.name);
  if (found == references.end()) return std::nullopt;
  return Target{number(*found, "objective"), number(*found, "residual_rms"), number(*found, "total_dwell")};
}

std::string reference_in_words(const nlohmann::json& r) {
  const auto share = [&](const char* key) {
    return r.at(key).is_null() ? std::string("not known") : fmt::format("{:.1e}", number(r, key));
  };
  return fmt::format(
      "objective {:.8g} nm^2, residual {:.5g} nm, total {:.5g} s; smoothness {:.4g}, time price {:.4g} nm^2/s ({}); "
      "above the optimum by at most {}, changed when doubled by {}: {}",
      number(r, "objective"), number(r, "residual_rms"), number(r, "total_dwell"), number(r, "smoothness"),
      number(r, "time_price"), text_of(r, "weights_from"), share("proven_share"), share("change_when_doubled"),
      r.at("settled").get<bool>() ? "settled, " + text_of(r, "by") : "NOT settled");
}

}  // namespace dwell::bench
