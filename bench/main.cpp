// dwell-bench: measures the operators, the planner and the solvers.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "bench/certificate_run.h"
#include "bench/plan_run.h"
#include "bench/planner_run.h"
#include "bench/reference.h"
#include "bench/report.h"
#include "bench/results.h"
#include "bench/scenario_list.h"
#include "bench/solve_run.h"
#include "bench/suite.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

const std::vector<std::string> kParts{"plans", "planners", "micro", "certificates", "scenarios"};
constexpr double kQuickBudget = 112.0, kFullBudget = 880.0;  // 2 and 15 minutes, less what ends a run [s]
constexpr double kPlannerShare = 0.3, kMicroShare = 0.4, kCertificateShare = 0.5;

struct Options {
  bool quick = false;
  bool to_certificate = false;
  std::string out;
  std::string data = DWELL_BENCH_DATA;
  std::string references = DWELL_BENCH_REFERENCES;
  std::string solver = "projected-cg";
  std::vector<std::string> scenario, parts;
  long plan_size = 0;
  int threads = 2;
  double max_seconds = 600.0;
  double budget = 0.0;
  double stop_gap = SolveOptions{}.stop_gap;
  double gradient_tolerance = SolveOptions{}.gradient_tolerance;
  std::string markdown, picture;
};

void save(const Options& options, const nlohmann::json& all) {
  if (!options.out.empty()) write_whole_file(options.out, all.dump(1) + "\n");
}

/// The picture as seen from the Markdown file.
std::string link_to_picture(const Options& options) {
  if (options.markdown.empty() || options.picture.empty()) return options.picture;
  return std::filesystem::absolute(options.picture)
      .lexically_relative(std::filesystem::absolute(options.markdown).parent_path())
      .generic_string();
}

/// Writes what was asked for of JSON, Markdown and picture, and prints the Markdown.
void deliver(const Options& options, const nlohmann::json& all) {
  save(options, all);
  const std::string text = markdown_report(all, link_to_picture(options));
  fmt::print("\n{}", text);
  if (!options.markdown.empty()) write_whole_file(options.markdown, text);
  if (!options.picture.empty()) write_whole_file(options.picture, chart_of(all));
}

nlohmann::json micro(const Options& options, const Budget& budget) {
  MicroOptions micro;
  micro.quick = options.quick;
  nlohmann::json results = nlohmann::json::array();
  for (const MicroResult& r : run_micro(micro, budget, kMicroShare)) results.push_back(to_json(r));
  return results;
}

nlohmann::json certificates(const Options& options, const Budget& budget) {
  CertificateRunOptions certificates{options.quick, "", options.data, options.references};
  certificates.scenario = !options.scenario.empty() ? options.scenario.front()
                          : options.quick           ? "a-256-every-4"
                                                    : "a-1024-every-4";
  return run_certificates(certificates, budget, kCertificateShare);
}

nlohmann::json plans(const Options& options, const Budget& budget) {
  const long size = options.plan_size > 0 ? options.plan_size : options.quick ? 1024 : 4096;
  return run_plans({size, options.quick ? 10.0 : 60.0, 2, options.data}, budget);
}

/// Only a whole run has all the tables that the targets need. The shares of the budget leave enough for the later
/// parts.
void measure(const Options& options) {
  const Budget budget(options.budget > 0.0 ? options.budget : options.quick ? kQuickBudget : kFullBudget);
  nlohmann::json all{{"machine", to_json(this_machine())}, {"budget", budget.total()}};
  const auto part = [&](const std::string& name, const std::function<void()>& run) {
    const auto& parts = options.parts;
    if (!parts.empty() && std::find(parts.begin(), parts.end(), name) == parts.end()) return;
    const double before = budget.spent();
    run();
    all["seconds"][name] = budget.spent() - before;
  };
  part("plans", [&] { all["plans"] = plans(options, budget); });
  part("planners", [&] { all["planners"] = run_planners(options.quick, budget, kPlannerShare); });
  part("micro", [&] { all["micro"] = micro(options, budget); });
  part("certificates", [&] { all["certificates"] = certificates(options, budget); });
  part("scenarios", [&] {
    all.update(run_suite({options.quick, options.scenario, options.data, options.references}, budget));
  });
  all["seconds"]["all"] = budget.spent();
  deliver(options, all);
}

void solve(const Options& options) {
  const auto all = scenarios(options.data);
  SolveOptions solve;
  solve.kind = parse_solver_kind(options.solver);
  solve.threads = options.threads;
  solve.stop_at_target = !options.to_certificate;
  solve.stop_gap = options.stop_gap;
  solve.gradient_tolerance = options.gradient_tolerance;
  solve.max_seconds = options.max_seconds;
  const Scenario& scenario = find_scenario(all, options.scenario.at(0));
  solve.target = target_of(read_references(options.references), scenario);
  const nlohmann::json result = solve_once(scenario, solve);
  if (options.out.empty()) fmt::print("{}\n", result.dump(1));
  save(options, result);
}

void reference(const Options& options) {
  nlohmann::json references = read_references(options.references);
  for (const Scenario& s : scenarios(options.data)) {
    const auto& wanted = options.scenario;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), s.name) == wanted.end()) continue;
    fmt::print("{}: ", s.name);
    std::fflush(stdout);
    references[s.name] = make_reference(s, parse_solver_kind(options.solver), options.threads, options.max_seconds);
    const auto& r = references[s.name];
    fmt::print("objective {:.8g}, residual {:.5g} nm, total {:.5g} s, changed by {:.2g} when doubled to {}: {}\n",
               r.at("objective").get<double>(), r.at("residual_rms").get<double>(), r.at("total_dwell").get<double>(),
               r.at("change_when_doubled").get<double>(), r.at("iterations").get<long>(),
               r.at("settled").get<bool>() ? "settled" : "NOT settled");
    write_whole_file(options.references, references.dump(1) + "\n");
  }
}

void add_measuring(CLI::App& app, Options& options) {
  app.add_flag("--quick", options.quick, "small sizes, short repetitions, in 2 minutes instead of 15");
  app.add_option("--part", options.parts, "of what is measured; default all")->check(CLI::IsMember(kParts));
  app.add_option("--budget", options.budget, "wall clock of all [s]; what finds no time in it is left out and said so");
  app.add_option("--scenario", options.scenario, "names; default all; certificates are of the first");
  app.add_option("--plan-size", options.plan_size, "edge of the map that is planned [pixels]");
}

int run(int argc, char** argv) {
  CLI::App app{"Measures the operators, the planner and the solvers of dwell."};
  app.require_subcommand(0, 1);
  Options options;
  add_measuring(app, options);
  CLI::App* solve_command = app.add_subcommand("solve", "one solver on one scenario, once");
  CLI::App* reference_command = app.add_subcommand("reference", "make the reference objectives");
  CLI::App* report_command = app.add_subcommand("report", "Markdown and picture of the JSON file of an earlier run");
  for (CLI::App* command : {&app, solve_command, reference_command}) {
    command->add_option("--out", options.out, "write the results to this JSON file");
    command->add_option("--data", options.data, "folder of public mirrors");
    command->add_option("--references", options.references, "JSON file of reference objectives");
  }
  for (CLI::App* command : {&app, report_command}) {
    command->add_option("--markdown", options.markdown, "write the tables to this file");
    command->add_option("--picture", options.picture, "draw quality against time into this PNG file");
  }
  std::string file;
  report_command->add_option("FILE", file, "what --out wrote")->required();
  for (CLI::App* command : {solve_command, reference_command}) {
    command->add_option("--scenario", options.scenario, "names of scenarios")->required(command == solve_command);
    command->add_option("--solver", options.solver, "word of the solver");
    command->add_option("--threads", options.threads);
    command->add_option("--max-seconds", options.max_seconds, "for each scenario");
  }
  solve_command->add_flag("--to-certificate", options.to_certificate, "go on until the certificate is reached");
  solve_command->add_option("--stop-gap", options.stop_gap, "else end this close to the reference; relative");
  solve_command->add_option("--gradient-tolerance", options.gradient_tolerance, "of the certificate; relative");
  CLI11_PARSE(app, argc, argv);
  if (solve_command->parsed()) {
    solve(options);
  } else if (reference_command->parsed()) {
    reference(options);
  } else if (report_command->parsed()) {
    deliver(options, nlohmann::json::parse(read_whole_file(file)));
  } else {
    measure(options);
  }
  return 0;
}

}  // namespace
}  // namespace dwell::bench

int main(int argc, char** argv) {
  try {
    return dwell::bench::run(argc, argv);
  } catch (const dwell::InputError& e) {
    fmt::print(stderr, "dwell-bench: {}\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "dwell-bench: internal fault: {}\n", e.what());
    return 1;
  }
}
