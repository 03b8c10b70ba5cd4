#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/json_access.h"
#include "bench/planner_run.h"
#include "bench/results.h"
#include "bench/solver_tables.h"
#include "bench/targets.h"
#include "runs/drawing/line_chart.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

std::string machine_line(const Json& m) {
  return fmt::format("{}, {} cores, {:.0f} GiB; {}, `{}`; {}; commit {}; {}.\n", text_of(m, "processor"),
                     m.at("cores").get<int>(), number(m, "memory_gib"), text_of(m, "compiler"), text_of(m, "flags"),
                     text_of(m, "fftw"), text_of(m, "commit"), text_of(m, "date"));
}

/// The parts of the run and their times; empty if the results have no times.
std::string time_line(const Json& all) {
  if (!all.contains("seconds")) return "";
  std::string text = fmt::format("\nThe run took {:.0f} s of the {:.0f} s that it was given",
                                 number(all["seconds"], "all"), number(all, "budget"));
  for (const auto& [part, seconds] : all["seconds"].items()) {
    if (part != "all") text += fmt::format("; {} {:.0f} s", part, seconds.get<double>());
  }
  if (all.contains("suite_seconds"))
    text += fmt::format(" ({:.0f} s solving, {:.0f} s starting processes and making their instances)",
                        number(all["suite_seconds"], "solving"), number(all["suite_seconds"], "around"));
  text += ".";
  std::size_t skipped = 0;
  for (const char* part : {"results", "certificates", "plans"}) {
    for (const Json& r : list_of(all, part)) skipped += r.contains("skipped") ? 1 : 0;
  }
  if (skipped > 0) text += fmt::format(" Left out, and shown as skipped: {} measurements.", skipped);
  return text + "\n";
}

constexpr const char* kSolvers =
    "\n## Solvers: time to equal quality\n\n"
    "Every scenario fixes a time price and a smoothness. Quality is the objective relative to a reference whose "
    "objective changes by less than 1e-6 when the work is doubled. All solvers start at the lower bound, stop at "
    "1e-4 of the reference or by their own certificate of 1e-6 or at their time limit, and run in processes of "
    "their own in interleaved rounds: medians, and from fastest to slowest in brackets. Pairs: operator "
    "applications divided by two, plus work on coarser pixels by its count of operations; in brackets, seconds divided "
    "by those of a pair, which counts everything. Gradient: projected, relative to |A'z|. Memory: peak of the process "
    "while solving above what it held before, also as vectors of the larger of points and pixels.\n\n";

constexpr double kLeastGap = 1e-4;

bool is_drawn(const Json& run) { return run.at("threads").get<int>() == 2 && run.contains("trace"); }

/// The solvers that have a line, in the order of the results: the place of a solver is that of its colour.
std::vector<std::string> drawn_solvers(const Json& all) {
  std::vector<std::string> solvers;
  for (const Json& run : list_of(all, "results")) {
    if (is_drawn(run) && std::find(solvers.begin(), solvers.end(), text_of(run, "solver")) == solvers.end()) {
      solvers.push_back(text_of(run, "solver"));
    }
  }
  return solvers;
}

Colour solver_colour(const std::vector<std::string>& solvers, const std::string& solver) {
  constexpr std::array<Colour, 12> kColours{{{214, 39, 40},
                                             {31, 119, 180},
                                             {44, 160, 44},
                                             {255, 127, 14},
                                             {148, 103, 189},
                                             {140, 86, 75},
                                             {227, 119, 194},
                                             {23, 190, 207},
                                             {188, 189, 34},
                                             {127, 127, 127},
                                             {0, 0, 0},
                                             {0, 90, 50}}};
  const auto place = std::find(solvers.begin(), solvers.end(), solver) - solvers.begin();
  return kColours[static_cast<std::size_t>(place) % kColours.size()];
}

/// Quality against time, as steps, because a solver that is stopped between two points returns what it had at the
/// first. A gap of zero, or below the least that is drawn, lies on the lower edge.
ChartLine gap_line(const Json& run, double reference, const std::vector<std::string>& solvers) {
  const std::string solver = text_of(run, "solver");
  ChartLine line{solver, solver_colour(solvers, solver), {}, false};
  line.steps = true;
  for (const Json& p : run.at("trace")) {
    const double gap = p.at(2).get<double>() / reference - 1.0;
    line.points.push_back({p.at(0).get<double>(), 100.0 * std::max(gap, kLeastGap)});
  }
  return line;
}

}  // namespace

std::string markdown_report(const Json& all, const std::string& picture) {
  std::string text = "# Benchmarks\n\nGenerated by `dwell-bench report`; do not edit.\n\n" +
                     machine_line(all.at("machine")) + time_line(all);
  text += "\n## Targets\n\n" + target_table(all);
  if (all.contains("results")) {
    text += kSolvers + summary_table(all);
    if (!picture.empty()) text += fmt::format("\n![quality against time]({})\n", picture);
    text += "\n## Threads\n\n`auto`, whole solve, as above.\n\n" + thread_table(all);
  }
  if (all.contains("certificates")) {
    text +=
        "\n## Certificate\n\nSolves that go on until the projected gradient is this small against |A'z|, each from the "
        "lower bound; judged by the certificate, which trusts no solver.\n\n" +
        certificate_table(all.at("certificates"));
  }
  if (all.contains("plans")) {
    text +=
        "\n## Whole plans\n\n`dwell plan` as a process, from files to feed table, program, simulation of the program, "
        "pictures and arrays: wall clock and peak of resident memory.\n\n" +
        plan_table(all.at("plans"));
  }
  if (all.contains("planners")) {
    text +=
        "\n## Planners\n\nOne thread, a square part of 512 x 512 pixels of 1 mm: from the map to the ordered path. "
        "Points "
        "a second are those of the fastest repetition.\n\n" +
        planner_table(all.at("planners"));
  }
  if (all.contains("micro")) {
    text +=
        "\n## Operators against the bare transform pair\n\nThe operators work in double precision. `-single`: the bare "
        "pair in single precision, which an operator in single could come to at best. `nearest-path`: the planner, by "
        "points. `read-...`: a map file into a checked map; `read-bytes`: the bytes of the NPY file and no more.\n\n" +
        micro_table(all.at("micro"));
  }
  if (all.contains("results")) {
    text += "\n## Scenarios\n";
    for (const Json& scenario : all.at("scenarios")) text += scenario_section(all, scenario);
  }
  return text;
}

std::string chart_of(const Json& all) {
  const std::vector<std::string> solvers = drawn_solvers(all);
  std::vector<ChartPanel> panels;
  for (const Json& scenario : list_of(all, "scenarios")) {
    if (scenario.at("reference").is_null()) continue;
    const double reference = number(scenario.at("reference"), "objective");
    ChartPanel panel{"time since the start of the solve [s]", "gap [%]", {}};
    panel.title = text_of(scenario, "name");
    panel.y_limits = ChartLimits{100.0 * kLeastGap, 1000.0};
    for (const Json& run : all.at("results")) {
      if (text_of(run, "scenario") == panel.title && is_drawn(run))
        panel.lines.push_back(gap_line(run, reference, solvers));
    }
    if (!panel.lines.empty()) panels.push_back(panel);
  }
  return draw_line_charts("Objective above the reference (gap), against time, 2 threads", "", panels);
}

}  // namespace dwell::bench
