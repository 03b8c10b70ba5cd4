// dwell-bench: measures the operators, the planner and the solvers.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/reference.h"
#include "bench/report.h"
#include "bench/results.h"
#include "bench/solve_run.h"
#include "bench/suite.h"
#include "core/errors.h"
#include "core/whole_file.h"

namespace dwell::bench {
namespace {

struct Options {
  bool quick = false;
  bool to_certificate = false;
  std::string out;
  std::string data = DWELL_BENCH_DATA;
  std::string references = DWELL_BENCH_REFERENCES;
  std::string solver = "projected-cg";
  std::vector<std::string> scenario;
  int threads = 2;
  double max_seconds = 600.0;
  double budget = 600.0;
  std::string markdown, picture;
};

nlohmann::json micro(const Options& options) {
  MicroOptions micro;
  micro.quick = options.quick;
  nlohmann::json results = nlohmann::json::array();
  for (const MicroResult& r : run_micro(micro)) results.push_back(to_json(r));
  return results;
}

void save(const Options& options, const nlohmann::json& all) {
  if (!options.out.empty()) write_whole_file(options.out, all.dump(1) + "\n");
}

/// Writes what was asked for of JSON, Markdown and picture, and prints the Markdown.
void deliver(const Options& options, const nlohmann::json& all) {
  save(options, all);
  const std::string text = markdown_report(all, std::filesystem::path(options.picture).filename().string());
  fmt::print("\n{}", text);
  if (!options.markdown.empty()) write_whole_file(options.markdown, text);
  if (!options.picture.empty()) write_whole_file(options.picture, chart_of(all));
}

nlohmann::json suite(const Options& options) {
  SuiteOptions suite;
  suite.quick = options.quick;
  suite.scenarios = options.scenario;
  suite.budget = options.budget;
  suite.data = options.data;
  suite.references = options.references;
  return run_suite(suite);
}

void measure(const Options& options, bool with_micro, bool with_scenarios) {
  nlohmann::json all{{"machine", to_json(this_machine())}};
  if (with_scenarios) all.update(suite(options));
  if (with_micro) all["micro"] = micro(options);
  deliver(options, all);
}

void solve(const Options& options) {
  const auto all = scenarios(options.data);
  SolveOptions solve;
  solve.kind = parse_solver_kind(options.solver);
  solve.threads = options.threads;
  solve.stop_at_target = !options.to_certificate;
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

int run(int argc, char** argv) {
  CLI::App app{"Measures the operators, the planner and the solvers of dwell."};
  app.require_subcommand(0, 1);
  Options options;
  const auto common = [&](CLI::App* command) {
    command->add_flag("--quick", options.quick, "small sizes, short repetitions");
    command->add_option("--out", options.out, "write the results to this JSON file");
    command->add_option("--data", options.data, "folder of public mirrors");
    command->add_option("--references", options.references, "JSON file of reference objectives");
  };
  common(&app);
  CLI::App* micro_command = app.add_subcommand("micro", "operators against the bare FFTW pair; the planner");
  CLI::App* solve_command = app.add_subcommand("solve", "one solver on one scenario, once");
  CLI::App* reference_command = app.add_subcommand("reference", "make the reference objectives");
  CLI::App* scenarios_command = app.add_subcommand("scenarios", "every solver on every scenario");
  CLI::App* report_command = app.add_subcommand("report", "Markdown and picture of the JSON file of an earlier run");
  for (CLI::App* command : {micro_command, scenarios_command, solve_command, reference_command}) common(command);
  for (CLI::App* command : {&app, scenarios_command, report_command}) {
    command->add_option("--markdown", options.markdown, "write the tables to this file");
    command->add_option("--picture", options.picture, "draw quality against time into this PNG file");
  }
  for (CLI::App* command : {&app, scenarios_command})
    command->add_option("--budget", options.budget, "start no solve later than this [s]");
  scenarios_command->add_option("--scenario", options.scenario, "names; default all");
  std::string file;
  report_command->add_option("FILE", file, "what --out wrote")->required();
  for (CLI::App* command : {solve_command, reference_command}) {
    command->add_option("--scenario", options.scenario, "names of scenarios")->required(command == solve_command);
    command->add_option("--solver", options.solver, "word of the solver");
    command->add_option("--threads", options.threads);
  }

  solve_command->add_flag("--to-certificate", options.to_certificate, "go on until the certificate is reached");
  reference_command->add_option("--max-seconds", options.max_seconds, "for each scenario");
  CLI11_PARSE(app, argc, argv);
  if (solve_command->parsed()) {
    solve(options);
  } else if (reference_command->parsed()) {
    reference(options);
  } else if (report_command->parsed()) {
    deliver(options, nlohmann::json::parse(read_whole_file(file)));
  } else {
    measure(options, !scenarios_command->parsed(), !micro_command->parsed());
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
