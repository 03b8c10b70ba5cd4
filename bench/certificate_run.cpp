#include "bench/certificate_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/solve_child.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

constexpr double kTolerances[] = {1e-3, 1e-4, 1e-5, 1e-6};
constexpr double kShortestProof = 2.0;  // a solve with less time than that would show nothing [s]

/// Whether the answer passes, by the certificate alone. The bounds have to hold exactly.
bool passes_certificate(const nlohmann::json& run, double tolerance) {
  if (!run.contains("certificate")) return false;
  const nlohmann::json& c = run["certificate"];
  const auto within = [&](const char* key, double most) { return c.at(key).get<double>() <= most; };
  return within("projected_gradient", tolerance) && within("dual_infeasibility", tolerance) &&
         within("bound_violation", 0.0);
}

std::string certificate_in_words(const nlohmann::json& run) {
  for (const char* why : {"late", "failed", "refused", "skipped"}) {
    if (run.contains(why)) return run[why].get<std::string>();
  }
  return fmt::format("{} after {:.2f} s", run["certified"].get<bool>() ? "reached" : "not reached",
                     run["seconds"].get<double>());
}

}  // namespace

nlohmann::json run_certificates(const CertificateRunOptions& options, const Budget& budget, double share,
                                Measurements& measurements) {
  const double longest = options.extent == Extent::Quick ? 4.0 : 30.0;
  nlohmann::json all = nlohmann::json::array();
  for (const SolverKind kind : {SolverKind::Auto, SolverKind::ProjectedCg}) {
    bool go_on = true;
    double around = 0.0;  // time of a process besides solving [s]
    for (const double tolerance : kTolerances) {
      nlohmann::json run;
      const double left = budget.left(share) - around;
      if (!go_on) {
        run = {{"skipped", "the one before was not reached"}};
      } else if (left < kShortestProof) {
        run = {{"skipped", "no time left"}};
      } else {
        SolveRequest request;
        request.scenario = options.scenario;
        request.solver = to_string(kind);
        request.max_seconds = std::min(longest, left);
        request.wall_limit = budget.endless() ? 0.0 : budget.left();
        request.to_certificate = true;
        request.gradient_tolerance = tolerance;
        request.data = options.data;
        request.references = options.references;
        const std::string name = fmt::format("certificates/{}/{}/{:g}", options.scenario, request.solver, tolerance);
        run = measurements.take(name, [&] { return solve_in_child(request); });
        run["certified"] = passes_certificate(run, tolerance);
        go_on = run["certified"];
        if (run.contains("seconds")) around = run["process_seconds"].get<double>() - run["seconds"].get<double>();
      }
      run.update(
          {{"scenario", options.scenario}, {"solver", to_string(kind)}, {"threads", 2}, {"tolerance", tolerance}});
      fmt::print("{:7.1f} s  {:18} {:14} to certificate {:g}: {}\n", budget.spent(), options.scenario, to_string(kind),
                 tolerance, certificate_in_words(run));
      std::fflush(stdout);
      all.push_back(std::move(run));
    }
  }
  return all;
}

}  // namespace dwell::bench
