#include "bench/suite.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "bench/child.h"
#include "bench/reference.h"
#include "bench/scenario.h"
#include "core/whole_file.h"

namespace dwell::bench {
namespace {

/// One line of the table: its runs so far.
struct Entry {
  std::string scenario;
  SolverKind kind;
  int threads;
  std::vector<nlohmann::json> runs;

  bool reached_all() const {
    return !runs.empty() && runs.front().contains("reached") && !runs.front()["reached"]["objective"].back().is_null();
  }
};

class Suite {
 public:
  explicit Suite(const SuiteOptions& options) : options_(options), all_(scenarios(options.data)) {
    for (const std::string& name : options.scenarios) find_scenario(all_, name);
    for (const Scenario& s : all_) {
      const auto& wanted = options.scenarios;
      if (!wanted.empty() ? std::find(wanted.begin(), wanted.end(), s.name) == wanted.end() : options.quick && !s.quick)
        continue;
      for (const SolverKind kind : solver_kinds()) {
        if (is_peer(kind) && !s.peers) continue;
        for (const int threads : {2, 1}) entries_.push_back({s.name, kind, threads, {}});
      }
    }
  }

  void run() {
    const int rounds = options_.quick ? 1 : options_.rounds;
    for (int round = 0; round < rounds; ++round) {
      for (Entry& entry : entries_) {
        if (round == 0 && entry.threads != 2) continue;
        if (round > 0 && !worth_repeating(entry)) continue;
        if (seconds() > options_.budget) return;
        entry.runs.push_back(run_once(entry));
      }
    }
  }

  nlohmann::json results() const {
    nlohmann::json all = nlohmann::json::array();
    for (const Entry& entry : entries_) {
      if (!entry.runs.empty()) all.push_back(summarise(entry));
    }
    return all;
  }

  nlohmann::json descriptions() const {
    nlohmann::json all = nlohmann::json::array();
    const nlohmann::json references = read_references(options_.references);
    for (const Scenario& s : all_) {
      const bool used =
          std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.scenario == s.name; });
      if (!used) continue;
      nlohmann::json d{{"name", s.name}, {"what", s.what}, {"smoothness", s.smoothness}, {"price", s.price}};
      d["reference"] = target_of(references, s) ? references.at(s.name) : nlohmann::json();
      all.push_back(d);
    }
    return all;
  }

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  /// The first round ran on two threads; what did not finish there is not waited for again.
  bool worth_repeating(const Entry& entry) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.scenario == entry.scenario && e.kind == entry.kind && e.threads == 2 && e.reached_all();
    });
  }

  nlohmann::json run_once(const Entry& entry) const {
    const auto out = std::filesystem::temp_directory_path() / fmt::format("dwell-bench-{}.json", getpid());
    std::filesystem::remove(out);
    const auto end = run_child({"solve", "--scenario", entry.scenario, "--solver", to_string(entry.kind), "--threads",
                                std::to_string(entry.threads), "--data", options_.data.string(), "--references",
                                options_.references.string(), "--out", out.string()},
                               entry.threads);
    nlohmann::json run;
    if (end == ChildEnd::Done) {
      run = nlohmann::json::parse(read_whole_file(out));
    } else {
      run = {{"killed", end == ChildEnd::Killed ? "not done after twice its time limit" : "the process failed"}};
    }
    std::filesystem::remove(out);
    fmt::print("{:7.1f} s  {:18} {:14} {} threads: {}\n", seconds(), entry.scenario, to_string(entry.kind),
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

  static nlohmann::json summarise(const Entry& entry) {
    nlohmann::json result = entry.runs.front();
    result["scenario"] = entry.scenario;
    result["solver"] = to_string(entry.kind);
    result["threads"] = entry.threads;
    result["rounds"] = entry.runs.size();
    if (!result.contains("reached")) return result;
    for (const char* what : {"objective", "residual"}) {
      for (std::size_t q = 0; q < std::size(kQualities); ++q) {
        std::vector<double> seconds;
        for (const auto& run : entry.runs) {
          if (!run.contains("reached")) continue;
          const auto& slot = run["reached"][what][q];
          if (!slot.is_null()) seconds.push_back(slot["seconds"]);
        }
        nlohmann::json& slot = result["reached"][what][q];
        if (seconds.empty() || slot.is_null()) continue;
        std::sort(seconds.begin(), seconds.end());
        slot["seconds"] = 0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]);
        slot["fastest"] = seconds.front();
        slot["slowest"] = seconds.back();
      }
    }
    return result;
  }

  SuiteOptions options_;
  std::vector<Scenario> all_;
  std::vector<Entry> entries_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

bool is_peer(SolverKind kind) {
  switch (kind) {
    case SolverKind::DenseNnls:
    case SolverKind::Ceres:
    case SolverKind::Lbfgsb:
    case SolverKind::NloptLbfgs:
    case SolverKind::NloptMma:
    case SolverKind::NloptTnewton:
    case SolverKind::NloptSlsqp:
    case SolverKind::Fourier:
      return true;
    default:
      return false;
  }
}

nlohmann::json run_suite(const SuiteOptions& options) {
  Suite suite(options);
  suite.run();
  return {{"scenarios", suite.descriptions()}, {"results", suite.results()}, {"seconds", suite.seconds()}};
}

}  // namespace dwell::bench
