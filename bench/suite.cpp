#include "bench/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "bench/peer_limit.h"
#include "bench/reference.h"
#include "bench/scenario_list.h"
#include "bench/solve_child.h"
#include "bench/solver_list.h"
#include "bench/statistics.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

/// A run with a budget: every entry that has not yet run in `round`, until that share of it is spent.
struct Pass {
  std::size_t round;
  double share;
};
constexpr Pass kPasses[] = {{0, 0.8}, {1, 0.9}, {0, 1.0}, {2, 1.0}};
constexpr double kShortestSolve = 1.0;  // with less time than that, a solve is not worth making its instance [s]

std::size_t rounds_of(Extent extent) { return extent == Extent::Quick ? 1 : extent == Extent::Default ? 2 : 3; }

double longest_of_auto(Extent extent) {
  return extent == Extent::Quick ? 10.0 : extent == Extent::Default ? 60.0 : 600.0;
}

/// One line of the table: its runs so far.
struct Entry {
  const Scenario* scenario;
  const BenchSolver* solver;
  int threads;
  std::vector<Json> runs;
  std::string skipped = "no time left in the budget";  // the reason if there is none

  bool is_auto() const { return solver->name == "auto"; }
};

bool arrived(const Json& run) {
  return run.contains("reached") && !run.at("reached").at("objective").at(kOnePercent).is_null();
}

/// A second run of who did not arrive would say the same, and noise matters little in a long one.
bool worth_repeating(const Json& run) {
  constexpr double kLong = 20.0;  // [s]
  return arrived(run) && run.value("seconds", 0.0) < kLong;
}

class Suite {
 public:
  Suite(const SuiteOptions& options, const Budget& budget, Measurements& measurements)
      : options_(options),
        budget_(budget),
        measurements_(measurements),
        references_(read_references(options.references)),
        all_(scenarios(options.data)),
        no_scripts_(why_no_scripts()) {
    for (const std::string& name : options.scenarios) find_scenario(all_, name);
    for (const std::string& name : options.solvers) find_bench_solver(name);
    if (no_scripts_) fmt::print("\n  THE PEERS OF bench/peers ARE NOT RUN: {}\n\n", *no_scripts_);
    if (options.extent == Extent::Full) {
      for (const Scenario& s : all_)
        for (const BenchSolver& solver : bench_solvers()) add(s, solver);
    } else {
      for (const BenchSolver& solver : bench_solvers())
        for (const Scenario& s : all_) add(s, solver);
    }
  }

  void run() {
    if (options_.extent != Extent::Default) {
      for (Entry& entry : entries_) {
        for (std::size_t round = 0; round < rounds_of(options_.extent); ++round) run(entry, round, 1.0);
      }
      return;
    }
    for (const Pass& pass : kPasses) {
      if (pass.round >= rounds_of(options_.extent)) continue;
      for (Entry& entry : entries_) {
        // `auto` has all its rounds at once, since the limits of the others come from them.
        const std::size_t last = entry.is_auto() ? rounds_of(options_.extent) - 1 : pass.round;
        for (std::size_t round = pass.round; round <= last; ++round) run(entry, round, pass.share);
      }
    }
  }

  Json results() const {
    Json all = Json::array();
    for (const Scenario& s : all_) {
      for (const Entry& entry : entries_) {
        if (entry.scenario == &s) all.push_back(summarise(entry));
      }
    }
    return all;
  }

  Json descriptions() const {
    Json all = Json::array();
    for (const Scenario& s : all_) {
      if (!wanted(s)) continue;
      Json d{{"name", s.name}, {"what", s.what}, {"lattice", s.lattice}};
      d["reference"] = target_of(references_, s) ? references_.at(s.name) : Json();
      all.push_back(d);
    }
    return all;
  }

  /// How long the suite spent on solving, and on starting processes and making instances around that [s].
  Json accounting() const {
    double solving = 0.0, all = 0.0;
    for (const Entry& entry : entries_) {
      for (const Json& run : entry.runs) {
        solving += run.value("seconds", 0.0);
        all += run.value("process_seconds", 0.0);
      }
    }
    return {{"solving", solving}, {"around", all - solving}};
  }

 private:
  bool wanted(const Scenario& s) const {
    const auto& names = options_.scenarios;
    if (names.empty()) return options_.extent != Extent::Quick || s.quick;
    return std::find(names.begin(), names.end(), s.name) != names.end();
  }

  void add(const Scenario& scenario, const BenchSolver& solver) {
    const auto& names = options_.solvers;
    const bool is_auto = solver.name == "auto";
    if (!wanted(scenario)) return;
    if (!names.empty() && !is_auto && std::find(names.begin(), names.end(), solver.name) == names.end()) return;
    entries_.push_back({&scenario, &solver, 2, {}});
    if (is_auto) entries_.push_back({&scenario, &solver, 1, {}});
  }

  const Entry* auto_entry(const Scenario& scenario) const {
    for (const Entry& e : entries_) {
      if (e.scenario == &scenario && e.is_auto() && e.threads == 2) return &e;
    }
    return nullptr;
  }

  /// The median of the times of `auto` to within 1 %, on two threads.
  std::optional<double> auto_seconds(const Scenario& scenario) const {
    const Entry* entry = auto_entry(scenario);
    std::vector<double> seconds;
    for (const Json& run : entry ? entry->runs : std::vector<Json>()) {
      if (arrived(run)) seconds.push_back(run["reached"]["objective"][kOnePercent]["seconds"]);
    }
    if (seconds.empty()) return std::nullopt;
    return statistics(seconds).median;
  }

  void run(Entry& entry, std::size_t round, double share) {
    if (entry.runs.size() != round) return;
    if (round > 0 && !entry.is_auto() && !worth_repeating(entry.runs.front())) return;
    if (!weights_of(references_, *entry.scenario)) {
      entry.skipped = "no reference";
      return;
    }
    double limit = longest_of_auto(options_.extent);
    std::optional<double> times;
    if (!entry.is_auto()) {
      const std::optional<double> own = auto_seconds(*entry.scenario);
      if (!own) {
        entry.skipped = "`auto` has no time to 1 % that would set its limit";
        return;
      }
      limit = peer_limit(*own);
      times = limit / *own;
      if (cannot_run(entry)) return;
    }
    const std::string name = fmt::format("scenarios/{}/{}/{} threads/round {}", entry.scenario->name,
                                         entry.solver->name, entry.threads, round + 1);
    // A limit that the budget cuts short would be no result: what does not fit is left for another run.
    if (budget_.left(share) < around_[entry.scenario] + (entry.is_auto() ? kShortestSolve : limit)) return;
    entry.runs.push_back(measurements_.take(name, [&] { return run_once(entry, limit, times); }));
    const Json& run = entry.runs.back();
    if (run.contains("seconds"))
      around_[entry.scenario] = run.value("process_seconds", 0.0) - run.value("seconds", 0.0);
  }

  /// Notes why this solver cannot take the problem, if it cannot.
  bool cannot_run(Entry& entry) {
    if (!entry.solver->script.empty() && no_scripts_) {
      entry.skipped = *no_scripts_;
      return true;
    }
    const Json& own = auto_entry(*entry.scenario)->runs.front();
    const double points = own.at("points").get<double>(), pixels = own.at("pixels").get<double>();
    if (!entry.solver->largest || points <= *entry.solver->largest) return false;
    entry.runs = {
        Json{{"too_large", why_not_taken(points, entry.solver->needs_pixels ? pixels : 0.0, *entry.solver->largest)}}};
    return true;
  }

  Json run_once(const Entry& entry, double limit, const std::optional<double>& times) {
    SolveRequest request;
    request.scenario = entry.scenario->name;
    request.solver = entry.solver->name;
    request.threads = entry.threads;
    request.max_seconds = entry.is_auto() ? std::min(limit, std::max(budget_.left(), kShortestSolve)) : limit;
    request.wall_limit = budget_.endless() ? 0.0 : std::max(1.0, budget_.left());
    request.data = options_.data;
    request.references = options_.references;
    Json run = solve_in_child(request);
    if (times) run["times_given"] = *times;
    fmt::print("{:7.1f} s  {:18} {:18} {} threads: {}\n", budget_.spent(), entry.scenario->name, entry.solver->name,
               entry.threads, in_words(run));
    std::fflush(stdout);
    return run;
  }

  static std::string in_words(const Json& run) {
    for (const char* why : {"refused", "failed", "late", "too_large"}) {
      if (run.contains(why)) return run[why];
    }
    std::string text;
    for (const auto& slot : run["reached"]["objective"])
      text += slot.is_null() ? "     -  " : fmt::format("{:7.3f} ", slot["seconds"].get<double>());
    return fmt::format("{}s; {}", text, not_there(run).value_or(run["message"].get<std::string>()));
  }

  Json summarise(const Entry& entry) const {
    Json result = entry.runs.empty() ? Json{{"skipped", entry.skipped}} : entry.runs.front();
    result["scenario"] = entry.scenario->name;
    result["solver"] = entry.solver->name;
    result["threads"] = entry.threads;
    result["rounds"] = entry.runs.size();
    if (!result.contains("reached")) return result;
    std::vector<double> whole;
    for (const auto& run : entry.runs) {
      if (run.contains("seconds")) whole.push_back(run["seconds"]);
    }
    put(result["whole"], whole);
    for (const char* what : {"objective", "residual"}) {
      for (std::size_t q = 0; q < std::size(kQualities); ++q) {
        std::vector<double> seconds;
        for (const auto& run : entry.runs) {
          if (run.contains("reached") && !run["reached"][what][q].is_null())
            seconds.push_back(run["reached"][what][q]["seconds"]);
        }
        Json& slot = result["reached"][what][q];
        if (!slot.is_null()) put(slot, seconds);
      }
    }
    return result;
  }

  static void put(Json& slot, const std::vector<double>& seconds) {
    const Statistics s = statistics(seconds);
    slot["seconds"] = s.median;
    slot["fastest"] = s.fastest;
    slot["slowest"] = s.slowest;
  }

  const SuiteOptions& options_;
  const Budget& budget_;
  Measurements& measurements_;
  Json references_;
  std::vector<Scenario> all_;
  std::optional<std::string> no_scripts_;
  std::vector<Entry> entries_;
  std::map<const Scenario*, double> around_;  // time of a process besides solving, for making the instance [s]
};

}  // namespace

Json run_suite(const SuiteOptions& options, const Budget& budget, Measurements& measurements) {
  Suite suite(options, budget, measurements);
  suite.run();
  return {{"scenarios", suite.descriptions()}, {"results", suite.results()}, {"suite_seconds", suite.accounting()}};
}

}  // namespace dwell::bench
