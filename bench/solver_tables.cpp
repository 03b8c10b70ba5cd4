#include "bench/solver_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bench/json_access.h"
#include "bench/peer_limit.h"
#include "bench/solve_run.h"
#include "bench/solver_list.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

double reference_objective(const Json& scenario) {
  return scenario.at("reference").is_null() ? 0.0 : number(scenario.at("reference"), "objective");
}

bool stopped_by_clock(const Json& run) {
  return run.contains("late") || (run.contains("status") && text_of(run, "status") == "time limit");
}

std::string band(const Json& slot, const Json& run) {
  if (run.at("rounds").get<int>() == 1) return fmt::format("{:.3g}", number(slot, "seconds"));
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", number(slot, "seconds"), number(slot, "fastest"),
                     number(slot, "slowest"));
}

std::string seconds_cell(const Json& run, const char* what, std::size_t quality) {
  const Json& slot = run.at("reached").at(what).at(quality);
  if (!slot.is_null()) return band(slot, run);
  if (quality == kOnePercent && what == std::string("objective")) {
    if (const std::optional<std::string> late = not_there(run)) return *late;
  }
  // A solver that ended by itself was not stopped by the clock.
  return stopped_by_clock(run) ? fmt::format("> {:.3g}", number(run, "max_seconds")) : "never";
}

std::string pairs_cell(const Json& run, std::size_t quality) {
  const Json& slot = run.at("reached").at("objective").at(quality);
  const std::optional<Pairs> pairs = pairs_to(run, quality);
  if (!pairs) return "-";
  const double by_clock = number(slot, "seconds") / number(run, "pair_seconds");
  if (!(pairs->coarse > 0.0)) return fmt::format("{:.0f} ({:.0f})", pairs->fine, by_clock);
  return fmt::format("{:.0f} + {:.0f} = {:.0f} ({:.0f})", pairs->fine, pairs->coarse, pairs->total(), by_clock);
}

std::string line_of(const Json& run, double reference) {
  std::string line = fmt::format("| {} | {} |", text_of(run, "solver"), run.at("threads").get<int>());
  for (const std::string why : {"too_large", "late", "failed", "refused", "skipped"}) {
    if (!run.contains(why)) continue;
    std::string words = text_of(run, why.c_str());  // of "refused" and "too_large" the solver's own
    if (why == "late") words = fmt::format("{} ({})", not_there(run).value_or("late"), words);
    if (why == "skipped" || why == "failed") words = why + ": " + words;
    return line + fmt::format(" {} | | | | | | | | | | | | |\n", words);
  }
  const bool compared = reference > 0.0;
  for (const std::size_t q : {0U, 1U, 2U})
    line += fmt::format(" {} |", compared ? seconds_cell(run, "objective", q) : "");
  for (const std::size_t q : {0U, 1U, 2U}) line += fmt::format(" {} |", compared ? pairs_cell(run, q) : "");
  line += fmt::format(" {} |", compared ? seconds_cell(run, "residual", kOnePercent) : "");
  const Json& c = run.at("certificate");
  std::string memory;  // not known of scripts
  if (run.contains("solve_memory")) {
    memory = fmt::format("{:.0f} MiB, {:.1f}", number(run, "solve_memory") / 0x1p20,
                         number(run, "solve_memory") / (8.0 * std::max(number(run, "points"), number(run, "pixels"))));
  }
  line += fmt::format(" {} | {:.4g} | {:.5g} | {:.1e} | {} | {} |\n",
                      compared ? fmt::format("{:+.2g} %", 100.0 * (number(c, "objective") / reference - 1.0))
                               : fmt::format("{:.5g}", number(c, "objective")),
                      number(c, "residual_rms"), number(run, "total_dwell"), number(c, "projected_gradient"), memory,
                      text_of(run, "status"));
  return line;
}

std::string settled_in_words(const Json& reference) {
  if (!reference.at("settled").get<bool>()) return "not settled";
  if (text_of(reference, "by") == "proven")
    return fmt::format("proven to be above the optimum by at most {:.1e} of it", number(reference, "proven_share"));
  return fmt::format("changed by {:.1e} when the work was doubled", number(reference, "change_when_doubled"));
}

constexpr const char* kHead =
    "| solver | threads | s to 10 % | s to 1 % | s to 0.1 % | pairs to 10 % | to 1 % | to 0.1 % | residual: s to 1 % "
    "| objective at the end | residual nm | total s | gradient | memory, vectors | ended by |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";

/// Of ours, the one that is first within 1 % on two threads; null if there is none.
Json fastest_of_ours(const Json& all, const std::string& scenario) {
  Json best;
  for (const Json& run : all.at("results")) {
    if (text_of(run, "scenario") != scenario || run.at("threads").get<int>() != 2) continue;
    if (find_bench_solver(text_of(run, "solver")).peer || !seconds_to_1_percent(run)) continue;
    if (best.is_null() || *seconds_to_1_percent(run) < *seconds_to_1_percent(best)) best = run;
  }
  return best;
}

/// The peer and its seconds to 1 %, or the reason why there are none.
std::string peer_cell(const Json& all, const std::string& scenario, const std::optional<PeerRatio>& ratio) {
  if (ratio && !ratio->peer.empty()) {
    const Json run = find_run(all, scenario, ratio->peer, 2);
    return fmt::format("{} | {:.3g}", ratio->peer, *seconds_to_1_percent(run));
  }
  std::string most;  // of those that had time, which all had the same
  bool skipped = false, ran = false;
  for (const Json& run : list_of(all, "results")) {
    if (text_of(run, "scenario") != scenario || !find_bench_solver(text_of(run, "solver")).peer) continue;
    skipped = skipped || run.contains("skipped");
    ran = ran || run.contains("reached") || run.contains("late");
    if (const std::optional<std::string> late = not_there(run)) most = *late;
  }
  if (!most.empty()) return most + " | ";
  return ran ? "none comes within 1 % | " : skipped ? "not run | " : "too large | ";
}

}  // namespace

Json find_run(const Json& all, const std::string& scenario, const std::string& solver, int threads) {
  for (const Json& run : list_of(all, "results")) {
    if (text_of(run, "scenario") == scenario && text_of(run, "solver") == solver &&
        run.at("threads").get<int>() == threads)
      return run;
  }
  return {};
}

std::optional<double> seconds_to_1_percent(const Json& run) {
  if (run.is_null() || !run.contains("reached")) return std::nullopt;
  const Json& slot = run.at("reached").at("objective").at(kOnePercent);
  return slot.is_null() ? std::nullopt : std::optional(number(slot, "seconds"));
}

std::optional<Pairs> pairs_to(const Json& run, std::size_t quality) {
  if (run.is_null() || !run.contains("reached")) return std::nullopt;
  const Json& slot = run.at("reached").at("objective").at(quality);
  if (slot.is_null()) return std::nullopt;
  return Pairs{0.5 * number(slot, "applications"), number(slot, "coarse_pairs")};
}

std::optional<PeerRatio> peer_ratio(const Json& all, const std::string& scenario) {
  const std::optional<double> own = seconds_to_1_percent(find_run(all, scenario, "auto", 2));
  if (!own) return std::nullopt;
  double arrived = std::numeric_limits<double>::infinity(), stopped = arrived;
  std::string peer;
  for (const Json& run : list_of(all, "results")) {
    if (text_of(run, "scenario") != scenario || run.at("threads").get<int>() != 2) continue;
    if (!run.contains("reached") && !run.contains("late")) continue;
    if (!find_bench_solver(text_of(run, "solver")).peer) continue;
    const std::optional<double> seconds = seconds_to_1_percent(run);
    if (seconds && *seconds < arrived) {
      arrived = *seconds;
      peer = text_of(run, "solver");
    } else if (!seconds && stopped_by_clock(run)) {
      stopped = std::min(stopped, number(run, "max_seconds"));
    }
  }
  const double least = std::min(arrived, stopped);
  if (!(least < std::numeric_limits<double>::infinity())) return std::nullopt;
  return PeerRatio{least / *own, arrived <= stopped, peer};
}

std::optional<double> thread_ratio(const Json& all, const std::string& scenario) {
  const Json one = find_run(all, scenario, "auto", 1), two = find_run(all, scenario, "auto", 2);
  for (const Json& run : {one, two}) {
    if (run.is_null() || !run.contains("whole") || stopped_by_clock(run)) return std::nullopt;
  }
  if (text_of(one, "status") != text_of(two, "status")) return std::nullopt;
  return number(one.at("whole"), "seconds") / number(two.at("whole"), "seconds");
}

std::string summary_table(const Json& all) {
  std::string text =
      "| scenario | dwell points | `auto`: s to 1 % | pairs | fastest of ours | s to 1 % | fastest peer | s to 1 % | "
      "peer over `auto` | peer over fastest of ours |\n|---|---:|---:|---:|---|---:|---|---:|---:|---:|\n";
  for (const Json& scenario : all.at("scenarios")) {
    const std::string name = text_of(scenario, "name");
    if (!(reference_objective(scenario) > 0.0)) {
      text += fmt::format("| {} | no reference | | | | | | | | |\n", name);
      continue;
    }
    const Json run = find_run(all, name, "auto", 2), ours = fastest_of_ours(all, name);
    const std::optional<double> own = seconds_to_1_percent(run), best = seconds_to_1_percent(ours);
    const std::optional<PeerRatio> ratio = peer_ratio(all, name);
    const auto times = [&](double over) {
      return ratio ? fmt::format("{}{:.3g}", ratio->exact ? "" : "> ", ratio->ratio * over) : std::string();
    };
    const bool ran = !run.is_null() && run.contains("reached");
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name,
                        ran ? fmt::format("{}", run.at("points").get<long>()) : "",
                        ran ? seconds_cell(run, "objective", kOnePercent) : "not run",
                        ran ? pairs_cell(run, kOnePercent) : "", best ? text_of(ours, "solver") : "none in time",
                        best ? fmt::format("{:.3g}", *best) : "", peer_cell(all, name, ratio), times(1.0),
                        own && best ? times(*own / *best) : "");
  }
  return text;
}

std::string thread_table(const Json& all) {
  std::string text =
      "| scenario | s on 1 thread | s on 2 threads | 1 over 2 | pairs on 1, on 2 | ended by |\n"
      "|---|---:|---:|---:|---:|---|\n";
  for (const Json& scenario : all.at("scenarios")) {
    const std::string name = text_of(scenario, "name");
    const Json one = find_run(all, name, "auto", 1), two = find_run(all, name, "auto", 2);
    const auto cell = [](const Json& run) {
      return run.is_null() || !run.contains("whole") ? std::string("not run") : band(run.at("whole"), run);
    };
    const auto pairs = [](const Json& run) {
      if (run.is_null() || !run.contains("whole")) return std::string("-");
      return fmt::format("{:.0f}", 0.5 * number(run, "applications") + number(run, "coarse_pairs"));
    };
    const auto end = [](const Json& run) {
      return run.is_null() || !run.contains("whole") ? std::string("-") : text_of(run, "status");
    };
    const std::optional<double> ratio = thread_ratio(all, name);
    text += fmt::format("| {} | {} | {} | {} | {}, {} | {} |\n", name, cell(one), cell(two),
                        ratio ? fmt::format("{:.2f}", *ratio) : "", pairs(one), pairs(two),
                        end(one) == end(two) ? end(one) : end(one) + "; " + end(two));
  }
  return text;
}

std::string scenario_section(const Json& all, const Json& scenario) {
  const std::string name = text_of(scenario, "name");
  std::string text = fmt::format("\n### {}\n\n{}.", name, text_of(scenario, "what"));
  std::string table;
  bool described = false;
  for (const Json& run : all.at("results")) {
    if (text_of(run, "scenario") != name) continue;
    if (!described && run.contains("points")) {
      described = true;
      text +=
          fmt::format(" {} dwell points, {} pixels, {} operator, {:.3g} ms a pair on {} threads, made in {:.2g} s.",
                      run.at("points").get<long>(), run.at("pixels").get<long>(), text_of(run, "operator"),
                      1e3 * number(run, "pair_seconds"), run.at("threads").get<int>(), number(run, "build_seconds"));
    }
    table += line_of(run, reference_objective(scenario));
  }
  const Json& r = scenario.at("reference");
  if (r.is_null()) {
    text += " No reference: nothing to compare with, the objective itself is shown.\n\n";
  } else {
    text += fmt::format(
        " Smoothness {:.4g}, time price {:.4g} nm^2/s ({}). Reference: objective {:.7g} nm^2, residual {:.5g} nm, "
        "total "
        "{:.5g} s ({}).\n\n",
        number(r, "smoothness"), number(r, "time_price"), text_of(r, "weights_from"), number(r, "objective"),
        number(r, "residual_rms"), number(r, "total_dwell"), settled_in_words(r));
  }
  return text + kHead + table;
}

}  // namespace dwell::bench
