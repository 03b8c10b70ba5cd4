#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace dwell::bench {

/// `auto` against the peers and our other solvers within 1 % of the reference, a line a scenario.
std::string summary_table(const nlohmann::json& all);
/// `auto` on one thread and on two, whole solve, a line a scenario.
std::string thread_table(const nlohmann::json& all);
/// One scenario: what it is and every solver on it.
std::string scenario_section(const nlohmann::json& all, const nlohmann::json& scenario);

/// The line of a solver on a scenario and a number of threads; null if there is none.
nlohmann::json find_run(const nlohmann::json& all, const std::string& scenario, const std::string& solver, int threads);

/// Seconds to within 1 % of the reference; none if it was not reached.
std::optional<double> seconds_to_1_percent(const nlohmann::json& run);

/// Work to within a quality in operator pairs of the full problem.
struct Pairs {
  double fine = 0.0, coarse = 0.0;
  double total() const { return fine + coarse; }
};
std::optional<Pairs> pairs_to(const nlohmann::json& run, std::size_t quality);

/// How many times as long as `auto` the fastest peer on two threads takes to within 1 %: exact, or a lower bound if a
/// peer that the clock stopped might have been the fastest.
struct PeerRatio {
  double ratio = 0.0;
  bool exact = true;
  std::string peer;  // the fastest; empty if none arrived
};
/// Nothing if `auto` did not reach 1 %, if no peer was run, or if no peer that could reach it was given time.
std::optional<PeerRatio> peer_ratio(const nlohmann::json& all, const std::string& scenario);

/// Time on one thread over time on two, whole solve of `auto`; nothing unless both ended by the same rule and not by
/// the clock.
std::optional<double> thread_ratio(const nlohmann::json& all, const std::string& scenario);

}  // namespace dwell::bench
