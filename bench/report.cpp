#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/chart.h"
#include "bench/results.h"
#include "bench/suite.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

std::string text_of(const Json& j, const char* key) { return j.at(key).get<std::string>(); }
double number(const Json& j, const char* key) { return j.at(key).get<double>(); }

std::string seconds_cell(const Json& run, const char* what, std::size_t quality) {
  const Json& slot = run.at("reached").at(what).at(quality);
  if (slot.is_null()) {
    // A solver that ended by itself was not stopped by the clock.
    return text_of(run, "status") == "time limit" ? fmt::format("> {:.3g}", number(run, "max_seconds")) : "never";
  }
  if (run.at("rounds").get<int>() == 1) return fmt::format("{:.3g}", number(slot, "seconds"));
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", number(slot, "seconds"), number(slot, "fastest"),
                     number(slot, "slowest"));
}

std::string pairs_cell(const Json& run, std::size_t quality) {
  const Json& slot = run.at("reached").at("objective").at(quality);
  if (slot.is_null()) return "-";
  return fmt::format("{:.0f} / {:.0f}", 0.5 * number(slot, "applications"),
                     number(slot, "seconds") / number(run, "pair_seconds"));
}

std::string line_of(const Json& run, double reference) {
  std::string line = fmt::format("| {} | {} |", text_of(run, "solver"), run.at("threads").get<int>());
  for (const char* why : {"refused", "killed"}) {  // in the solver's own words
    if (run.contains(why)) return line + fmt::format(" {} | | | | | | | | | | | | | |\n", text_of(run, why));
  }
  for (const std::size_t q : {0U, 1U, 2U}) line += fmt::format(" {} |", seconds_cell(run, "objective", q));
  for (const std::size_t q : {0U, 1U, 2U}) line += fmt::format(" {} |", pairs_cell(run, q));
  line += fmt::format(" {} |", seconds_cell(run, "residual", 1));
  const Json& c = run.at("certificate");
  const double vectors = number(run, "solve_memory") / (8.0 * std::max(number(run, "points"), number(run, "pixels")));
  line +=
      fmt::format(" {} | {:.4g} | {:.5g} | {:.1e} | {:.0f} MiB, {:.1f} | {} |\n",
                  reference > 0.0 ? fmt::format("{:+.2g} %", 100.0 * (number(c, "objective") / reference - 1.0)) : "-",
                  number(c, "residual_rms"), number(run, "total_dwell"), number(c, "projected_gradient"),
                  number(run, "solve_memory") / 0x1p20, vectors, text_of(run, "status"));
  return line;
}

constexpr const char* kHead =
    "| solver | threads | s to 10 % | s to 1 % | s to 0.1 % | pairs to 10 % | to 1 % | to 0.1 % | residual: s to 1 % "
    "| objective at the end | residual nm | total s | gradient | memory, vectors | ended by |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";

double reference_objective(const Json& scenario) {
  return scenario.at("reference").is_null() ? 0.0 : number(scenario.at("reference"), "objective");
}

std::string scenario_section(const Json& all, const Json& scenario) {
  const std::string name = text_of(scenario, "name");
  std::string text = fmt::format("\n### {}\n\n{}.", name, text_of(scenario, "what"));
  std::string table;
  for (const Json& run : all.at("results")) {
    if (text_of(run, "scenario") != name) continue;
    if (table.empty() && run.contains("points"))
      text += fmt::format(" {} dwell points, {} pixels, {} operator, {:.3g} ms a pair on {} threads.",
                          run.at("points").get<long>(), run.at("pixels").get<long>(), text_of(run, "operator"),
                          1e3 * number(run, "pair_seconds"), run.at("threads").get<int>());
    table += line_of(run, reference_objective(scenario));
  }
  text += fmt::format(" Smoothness {:g}, price {:g}.", number(scenario, "smoothness"), number(scenario, "price"));
  const Json& r = scenario.at("reference");
  if (r.is_null()) {
    text += " No reference.\n\n";
  } else {
    text += fmt::format(
        " Reference: objective {:.7g}, residual {:.5g} nm, total {:.5g} s ({}, {} iterations; the last "
        "doubling changed it by {:.1e}{}).\n\n",
        number(r, "objective"), number(r, "residual_rms"), number(r, "total_dwell"), text_of(r, "solver"),
        r.at("iterations").get<long>(), number(r, "change_when_doubled"),
        r.at("settled").get<bool>() ? "" : ", not settled");
  }
  return text + kHead + table;
}

/// The run that is first within 1 % on two threads, among the peers or among the others; null if there is none.
Json fastest(const Json& all, const std::string& scenario, bool peer) {
  Json best;
  for (const Json& run : all.at("results")) {
    if (text_of(run, "scenario") != scenario || run.at("threads").get<int>() != 2 || !run.contains("reached")) continue;
    if (is_peer(parse_solver_kind(text_of(run, "solver"))) != peer) continue;
    const Json& slot = run.at("reached").at("objective").at(1);
    if (slot.is_null()) continue;
    if (best.is_null() || number(slot, "seconds") < number(best.at("reached").at("objective").at(1), "seconds"))
      best = run;
  }
  return best;
}

std::string summary_table(const Json& all) {
  std::string text =
      "| scenario | dwell points | fastest of ours | s to 1 % | pairs | fastest peer | s to 1 % | peer over ours |\n"
      "|---|---:|---|---:|---:|---|---:|---:|\n";
  for (const Json& scenario : all.at("scenarios")) {
    const std::string name = text_of(scenario, "name");
    const Json own = fastest(all, name, false), peer = fastest(all, name, true);
    const auto seconds = [](const Json& run) { return number(run.at("reached").at("objective").at(1), "seconds"); };
    const bool both = !own.is_null() && !peer.is_null();
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n", name,
        own.is_null() ? "" : fmt::format("{}", own.at("points").get<long>()),
        own.is_null() ? "none" : text_of(own, "solver"), own.is_null() ? "" : fmt::format("{:.3g}", seconds(own)),
        own.is_null() ? "" : pairs_cell(own, 1), peer.is_null() ? "none in time" : text_of(peer, "solver"),
        peer.is_null() ? "" : fmt::format("{:.3g}", seconds(peer)),
        both ? fmt::format("{:.1f}", seconds(peer) / seconds(own)) : "");
  }
  return text;
}

std::string machine_line(const Json& m) {
  return fmt::format("{}, {} cores, {:.0f} GiB; {}, `{}`; {}; commit {}; {}.\n", text_of(m, "processor"),
                     m.at("cores").get<int>(), number(m, "memory_gib"), text_of(m, "compiler"), text_of(m, "flags"),
                     text_of(m, "fftw"), text_of(m, "commit"), text_of(m, "date"));
}

}  // namespace

std::string markdown_report(const Json& all, const std::string& picture) {
  std::string text =
      "# Benchmarks\n\nGenerated by `dwell-bench report`; do not edit.\n\n" + machine_line(all.at("machine"));
  if (all.contains("results")) {
    text +=
        "\n## Solvers: time to equal quality\n\n"
        "Every scenario fixes a time price and a smoothness. Quality is the objective relative to a reference whose "
        "objective changes by less than 1e-6 when the work is doubled. All solvers start at the lower bound, stop at "
        "1e-4 of the reference or by their own certificate of 1e-6 or at their time limit, and run in processes of "
        "their own in interleaved rounds: medians, and from fastest to slowest in brackets. Pairs: operator "
        "applications divided by two / seconds divided by those of a pair, which counts work on coarser grids as "
        "well. Gradient: projected, relative to |A'z|. Memory: peak of the process while solving above what it held "
        "before, also as vectors of the larger of points and pixels.\n\n";
    text += summary_table(all) + fmt::format("\n![quality against time]({})\n", picture);
    for (const Json& scenario : all.at("scenarios")) text += scenario_section(all, scenario);
  }
  if (all.contains("micro")) {
    text +=
        "\n## Operators against the bare transform pair\n\nDouble precision; there are no operators in single. "
        "`nearest-path`: the planner, by points.\n\n" +
        micro_table(all.at("micro"));
  }
  return text;
}

std::string chart_of(const Json& all) {
  std::vector<ChartPanel> panels;
  for (const Json& scenario : all.at("scenarios")) {
    const double reference = reference_objective(scenario);
    ChartPanel panel{text_of(scenario, "name"), {}};
    for (const Json& run : all.at("results")) {
      if (text_of(run, "scenario") != panel.title || run.at("threads").get<int>() != 2 || !run.contains("trace"))
        continue;
      ChartLine line{text_of(run, "solver"), {}};
      for (const Json& p : run.at("trace"))
        line.points.push_back({p.at(0).get<double>(), p.at(2).get<double>() / reference - 1.0});
      panel.lines.push_back(line);
    }
    if (reference > 0.0 && !panel.lines.empty()) panels.push_back(panel);
  }
  return draw_chart(panels);
}

}  // namespace dwell::bench
