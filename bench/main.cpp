// dwell-bench: measures the operators, the planner and the solvers.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "bench/certificate_run.h"
#include "bench/child.h"
#include "bench/faults.h"
#include "bench/field_method.h"
#include "bench/measurements.h"
#include "bench/motion_sweep.h"
#include "bench/plan_run.h"
#include "bench/planner_run.h"
#include "bench/reference.h"
#include "bench/report.h"
#include "bench/results.h"
#include "bench/scenario_list.h"
#include "bench/script_solve.h"
#include "bench/solve_run.h"
#include "bench/solver_list.h"
#include "bench/suite.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

const std::vector<std::string> kParts{"plans", "planners", "micro", "certificates", "scenarios", "field"};
constexpr double kQuickBudget = 112.0, kDefaultBudget = 880.0;  // 2 and 15 minutes, less what ends a run [s]
constexpr double kPlanShare = 0.35, kPlannerShare = 0.4, kMicroShare = 0.5, kCertificateShare = 0.55;
constexpr const char* kResults = "out/bench/full-results.json";
constexpr const char* kFooter =
    "Example:\n"
    "  ./dev bench --quick                  # 2 minutes: that nothing is broken\n"
    "  ./dev bench                          # 15 minutes: what finds time; the rest is shown as skipped\n"
    "  ./dev bench --full --out out/bench/full.json\n"
    "                                       # everything, some hour; after an interrupt the same command goes on\n"
    "  ./dev bench report out/bench/full.json --markdown docs/benchmarks.md --picture docs/images/benchmarks.png\n"
    "  ./dev bench motion --picture docs/images/motion.png\n"
    "  ./dev bench reference --scenario c-3000 --new-weights\n";

struct Options {
  bool quick = false, full = false, anew = false;
  std::string results = kResults;
  bool to_certificate = false;
  bool new_weights = false;
  std::string out;
  std::string data = DWELL_BENCH_DATA;
  std::string references = DWELL_BENCH_REFERENCES;
  std::string solver = "projected-cg";
  std::vector<std::string> scenario, parts, solvers;
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

Extent extent_of(const Options& options) {
  if (options.quick && options.full) throw InputError("--quick and --full; accepted: one of them");
  if (options.full && options.budget > 0.0) throw InputError("--budget with --full; a full run takes what it takes");
  return options.quick ? Extent::Quick : options.full ? Extent::Full : Extent::Default;
}

Budget budget_of(const Options& options) {
  if (options.budget > 0.0) return Budget(options.budget);
  if (options.full) return Budget::without_end();
  return Budget(options.quick ? kQuickBudget : kDefaultBudget);
}

/// Everything that two runs must have in common for their figures to stand in one table.
nlohmann::json circumstances_of(const Options& options) {
  nlohmann::json c = to_json(this_machine());
  c.erase("date");
  // A commit says what was built only where nothing was changed since.
  c["benchmark program"] = sha256_of_file("/proc/self/exe");
  c["dwell program"] = sha256_of_file(dwell_program());
  c["references"] = std::filesystem::exists(options.references) ? sha256_of_file(options.references) : "none";
  c["data"] = std::filesystem::exists(options.data) ? "found" : "not found";
  c["parts"] = options.parts;
  c["scenarios"] = options.scenario;
  c["solvers"] = options.solvers;
  c["plan size"] = options.plan_size;
  return c;
}

Measurements measurements_of(const Options& options) {
  if (!options.full) return {};
  const std::filesystem::path file = options.results;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  if (options.anew) std::filesystem::remove(file);
  Measurements measurements(file, circumstances_of(options));
  if (measurements.taken_over() > 0) {
    fmt::print("goes on from {}: {} measurements that took {:.0f} s are taken over\n", file.string(),
               measurements.taken_over(), measurements.seconds(""));
  } else {
    fmt::print("every finished measurement is written to {} at once\n", file.string());
  }
  return measurements;
}

nlohmann::json micro(const Options& options, const Budget& budget) {
  MicroOptions micro;
  micro.quick = options.quick;
  nlohmann::json results = nlohmann::json::array();
  for (const MicroResult& r : run_micro(micro, budget, kMicroShare)) results.push_back(to_json(r));
  return results;
}

nlohmann::json certificates(const Options& options, const Budget& budget, Measurements& measurements) {
  CertificateRunOptions certificates{extent_of(options), "", options.data, options.references};
  certificates.scenario = !options.scenario.empty() ? options.scenario.front()
                          : options.quick           ? "a-256-every-4"
                                                    : "a-1024-every-4";
  return run_certificates(certificates, budget, kCertificateShare, measurements);
}

/// Returns what is wrong with the answers of a quick run, a sentence each.
std::vector<std::string> measure(const Options& options) {
  end_children_on_interrupt();
  const Extent extent = extent_of(options);
  const Budget budget = budget_of(options);
  Measurements measurements = measurements_of(options);
  nlohmann::json all{{"machine", to_json(this_machine())}, {"extent", to_string(extent)}, {"budget", budget.total()}};
  const auto part = [&](const std::string& name, const std::function<void()>& run) {
    const auto& parts = options.parts;
    if (!parts.empty() && std::find(parts.begin(), parts.end(), name) == parts.end()) return;
    run();
    all["seconds"][name] = measurements.seconds(name);
  };
  part("plans", [&] {
    all["plans"] = run_plans({extent, options.plan_size, options.data}, budget, kPlanShare, measurements);
  });
  part("planners", [&] {
    all["planners"] = measurements.take("planners", [&] { return run_planners(options.quick, budget, kPlannerShare); });
  });
  part("micro", [&] { all["micro"] = measurements.take("micro", [&] { return micro(options, budget); }); });
  part("certificates", [&] { all["certificates"] = certificates(options, budget, measurements); });
  const SuiteOptions suite{extent, options.scenario, options.solvers, options.data, options.references};
  part("field", [&] { all["field"] = run_field_method(suite, budget, measurements); });
  part("scenarios", [&] { all.update(run_suite(suite, budget, measurements)); });
  all["seconds"]["all"] = measurements.seconds("");
  deliver(options, all);
  return extent == Extent::Quick && all.contains("results") ? faults_of(all) : std::vector<std::string>();
}

void solve(const Options& options) {
  const auto all = scenarios(options.data);
  const BenchSolver& solver = find_bench_solver(options.solver);
  SolveOptions solve;
  if (solver.script.empty()) solve.kind = parse_solver_kind(options.solver);
  solve.threads = options.threads;
  solve.stop_at_target = !options.to_certificate;
  solve.stop_gap = options.stop_gap;
  solve.gradient_tolerance = options.gradient_tolerance;
  solve.max_seconds = options.max_seconds;
  const Scenario& scenario = find_scenario(all, options.scenario.at(0));
  const nlohmann::json references = read_references(options.references);
  solve.weights = required_weights(references, scenario);
  solve.target = target_of(references, scenario);
  const nlohmann::json result =
      solver.script.empty() ? solve_once(scenario, solve) : solve_by_script(scenario, solver, solve);
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
    const auto frozen = options.new_weights ? std::nullopt : weights_of(references, s);
    references[s.name] = make_reference(s, frozen, options.threads, options.max_seconds);
    fmt::print("{}\n", reference_in_words(references[s.name]));
    write_whole_file(options.references, references.dump(1) + "\n");
  }
}

void sweep(const Options& options) {
  const std::vector<MotionLoss> losses = sweep_motion(options.threads, Progress());
  const std::string text = motion_table_of(losses);
  fmt::print("{}", text);
  if (!options.markdown.empty()) write_whole_file(options.markdown, text);
  if (!options.picture.empty()) write_whole_file(options.picture, motion_chart_of(losses));
}

void add_measuring(CLI::App& app, Options& options) {
  app.add_flag(
      "--quick", options.quick,
      "small sizes, short repetitions, in 2 minutes instead of 15; exit code 1 if `auto` does not come within 1 % "
      "of a reference, or a peer does with less work");
  app.add_flag(
      "--full", options.full,
      "everything, as long as it takes (about an hour on 2 processors); each finished measurement is written to "
      "--results at once, and the same command goes on from there after an interrupt");
  app.add_option("--results", options.results,
                 "where --full keeps its measurements; refused if another commit, machine or options made them")
      ->capture_default_str();
  app.add_flag("--anew", options.anew, "with --full: forget what --results holds");
  app.add_option("--part", options.parts, "of what is measured; default all")->check(CLI::IsMember(kParts));
  app.add_option("--budget", options.budget, "wall clock of all [s]; what finds no time in it is left out and said so");
  app.add_option("--scenario", options.scenario, "names; default all; certificates are of the first");
  app.add_option("--solvers", options.solvers, "names of those to be measured besides auto; default all");
  app.add_option("--plan-size", options.plan_size, "edge of the map that is planned [pixels]");
}

int run(int argc, char** argv) {
  CLI::App app{"Measures the operators, the planner and the solvers of dwell."};
  app.require_subcommand(0, 1);
  app.footer(kFooter);
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
  CLI::App* motion_command = app.add_subcommand(
      "motion", "what accelerations of the machine cost, by path, planned without and with knowing them");
  for (CLI::App* command : {&app, report_command, motion_command}) {
    command->add_option("--markdown", options.markdown, "write the tables to this file");
    command->add_option("--picture", options.picture, "draw the figure of it into this PNG file");
  }
  std::string file;
  report_command->add_option("FILE", file, "what --out wrote")->required();
  for (CLI::App* command : {solve_command, reference_command}) {
    command->add_option("--scenario", options.scenario, "names of scenarios")->required(command == solve_command);
    command->add_option("--threads", options.threads);
    command->add_option("--max-seconds", options.max_seconds, "for each scenario");
  }
  solve_command->add_option("--solver", options.solver, "word of the solver");
  reference_command->add_flag("--new-weights", options.new_weights,
                              "find smoothness and price anew by the program's default rules, in place of the frozen");
  solve_command->add_flag("--to-certificate", options.to_certificate, "go on until the certificate is reached");
  solve_command->add_option("--stop-gap", options.stop_gap, "else end this close to the reference; relative");
  solve_command->add_option("--gradient-tolerance", options.gradient_tolerance, "of the certificate; relative");
  CLI11_PARSE(app, argc, argv);
  if (solve_command->parsed()) {
    solve(options);
  } else if (reference_command->parsed()) {
    reference(options);
  } else if (motion_command->parsed()) {
    sweep(options);
  } else if (report_command->parsed()) {
    deliver(options, nlohmann::json::parse(read_whole_file(file)));
  } else {
    const std::vector<std::string> faults = measure(options);
    for (const std::string& fault : faults) fmt::print(stderr, "dwell-bench: {}\n", fault);
    return faults.empty() ? 0 : 1;
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
  } catch (const dwell::Interrupted&) {
    fmt::print(stderr, "dwell-bench: interrupted; with --full, the same command goes on\n");
    return 130;
  } catch (const std::exception& e) {
    fmt::print(stderr, "dwell-bench: internal fault: {}\n", e.what());
    return 1;
  }
}
