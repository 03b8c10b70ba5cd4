#include "bench/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/reference.h"
#include "bench/scenario_list.h"
#include "bench/solve_child.h"
#include "solvers/solver_catalogue.h"

namespace dwell::bench {
namespace {

/// Runs every entry that has not yet run in `round`, until that share of the budget is spent.
struct Pass {
  std::size_t round;
  double share;
};
constexpr Pass kPasses[] = {{0, 0.7}, {1, 0.9}, {0, 1.0}, {2, 1.0}};
constexpr Pass kQuickPasses[] = {{0, 1.0}, {1, 1.0}};

constexpr double kShortestSolve = 1.0;  // with less time than that, a solve is not worth making its instance [s]

struct Statistics {
  double median, fastest, slowest;
};

Statistics statistics(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return {0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]), v.front(), v.back()};
}

/// One line of the table: its runs so far.
struct Entry {
  const Scenario* scenario;
  SolverKind kind;
  int threads;
  std::vector<nlohmann::json> runs;

  bool reached_all() const {
    return !runs.empty() && runs.front().contains("reached") && !runs.front()["reached"]["objective"].back().is_null();
  }
};

class Suite {
 public:
  Suite(const SuiteOptions& options, const Budget& budget)
      : options_(options), budget_(budget), all_(scenarios(options.data)) {
    for (const std::string& name : options.scenarios) find_scenario(all_, name);
    // In the order of the catalogue, so that what the budget cuts off is what matters least.
    for (const SolverRecord& solver : solver_catalogue()) {
      for (const Scenario& s : all_) {
        if (!wanted(s) || (solver.peer && !s.peers)) continue;
        for (const int threads : {2, 1}) entries_.push_back({&s, solver.kind, threads, {}});
      }
    }
  }

  void run() {
    if (options_.quick) {
      for (const Pass& pass : kQuickPasses) run(pass);
    } else {
      for (const Pass& pass : kPasses) run(pass);
    }
  }

  nlohmann::json results() const {
    nlohmann::json all = nlohmann::json::array();
    for (const Scenario& s : all_) {
      for (const Entry& entry : entries_) {
        if (entry.scenario == &s && (!entry.runs.empty() || first_turn(entry) == 0)) all.push_back(summarise(entry));
      }
    }
    return all;
  }

  nlohmann::json descriptions() const {
    nlohmann::json all = nlohmann::json::array();
    const nlohmann::json references = read_references(options_.references);
    for (const Scenario& s : all_) {
      if (!wanted(s)) continue;
      nlohmann::json d{
          {"name", s.name}, {"what", s.what}, {"smoothness", s.smoothness}, {"price", s.price}, {"peers", s.peers}};
      d["reference"] = target_of(references, s) ? references.at(s.name) : nlohmann::json();
      all.push_back(d);
    }
    return all;
  }

  /// How long the suite spent on solving, and on starting processes and making instances around that [s].
  nlohmann::json accounting() const {
    return {{"solving", solve_seconds_}, {"around", process_seconds_ - solve_seconds_}};
  }

 private:
  bool wanted(const Scenario& s) const {
    const auto& names = options_.scenarios;
    if (names.empty()) return !options_.quick || s.quick;
    return std::find(names.begin(), names.end(), s.name) != names.end();
  }

  /// The other solvers run on one thread only from round 1 on, when it is known whether they reach the reference on
  /// two.
  static std::size_t first_turn(const Entry& entry) {
    return entry.threads == 2 || entry.kind == SolverKind::Auto ? 0 : 1;
  }

  void run(const Pass& pass) {
    for (Entry& entry : entries_) {
      // An entry whose first turn is round 1 still runs at most once a round.
      if (pass.round < first_turn(entry) || entry.runs.size() + first_turn(entry) > pass.round) continue;
      if (pass.round > 0 && !worth_repeating(entry)) continue;
      const double left = budget_.left(pass.share) - around_[entry.scenario];
      if (left < kShortestSolve) continue;
      entry.runs.push_back(run_once(entry, left));
    }
  }

  /// A solver that did not reach the reference in its first round is not run again.
  bool worth_repeating(const Entry& entry) const {
    if (entry.kind == SolverKind::Auto) return true;
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.scenario == entry.scenario && e.kind == entry.kind && e.threads == 2 && e.reached_all();
    });
  }

  nlohmann::json run_once(const Entry& entry, double left) {
    const double usual = entry.kind == SolverKind::Auto ? 60.0 : std::max(20.0, entry.scenario->patience);
    const double longest = options_.quick ? 3.0 : usual;
    const nlohmann::json run = solve_in_child({.scenario = entry.scenario->name,
                                               .kind = entry.kind,
                                               .threads = entry.threads,
                                               .max_seconds = std::min(longest, left),
                                               .wall_limit = std::max(1.0, budget_.left()),
                                               .data = options_.data,
                                               .references = options_.references});
    const double process = run["process_seconds"], solve = run.value("seconds", 0.0);
    if (run.contains("seconds")) around_[entry.scenario] = process - solve;
    process_seconds_ += process;
    solve_seconds_ += solve;
    fmt::print("{:7.1f} s  {:18} {:14} {} threads: {}\n", budget_.spent(), entry.scenario->name, to_string(entry.kind),
               entry.threads, in_words(run));
    std::fflush(stdout);
    return run;
  }

  static std::string in_words(const nlohmann::json& run) {
    if (run.contains("killed")) return run["killed"];
    if (run.contains("refused")) return "refused";
    std::string text;
    for (const auto& slot : run["reached"]["objective"])
      text += slot.is_null() ? "     -  " : fmt::format("{:7.3f} ", slot["seconds"].get<double>());
    return fmt::format("{}s; {}", text, run["message"].get<std::string>());
  }

  nlohmann::json summarise(const Entry& entry) const {
    nlohmann::json result =
        entry.runs.empty() ? nlohmann::json{{"skipped", "no time left in the budget"}} : entry.runs.front();
    result["scenario"] = entry.scenario->name;
    result["solver"] = to_string(entry.kind);
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
        nlohmann::json& slot = result["reached"][what][q];
        if (!slot.is_null()) put(slot, seconds);
      }
    }
    return result;
  }

  static void put(nlohmann::json& slot, const std::vector<double>& seconds) {
    const Statistics s = statistics(seconds);
    slot["seconds"] = s.median;
    slot["fastest"] = s.fastest;
    slot["slowest"] = s.slowest;
  }

  const SuiteOptions& options_;
  const Budget& budget_;
  std::vector<Scenario> all_;
  std::vector<Entry> entries_;
  std::map<const Scenario*, double> around_;  // time of a process besides solving, for making the instance [s]
  double process_seconds_ = 0.0, solve_seconds_ = 0.0;
};

}  // namespace

nlohmann::json run_suite(const SuiteOptions& options, const Budget& budget) {
  Suite suite(options, budget);
  suite.run();
  return {{"scenarios", suite.descriptions()}, {"results", suite.results()}, {"suite_seconds", suite.accounting()}};
}

}  // namespace dwell::bench
