#include "cli/sweep_reports.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/campaigns/pareto_output.h"
#include "runs/campaigns/path_comparison_output.h"
#include "runs/reports/travel_words.h"

namespace dwell::cli {
namespace {

/// The text for people: the front of the sweep.
std::string front_text(const ParetoSweep& sweep) {
  std::string text = sweep.sheet.map_lines + sweep.sheet.tool_lines;
  const auto on_front =
      std::count_if(sweep.points.begin(), sweep.points.end(), [](const auto& p) { return p.on_front; });
  long applications = 0;
  for (const ParetoPoint& p : sweep.points) applications += p.solver.operator_applications;
  text += fmt::format("solves    {}, {}, {:.2f} s; {} on the Pareto front:\n", sweep.points.size(),
                      counted(applications, "operator application"), sweep.seconds(), on_front);
  text += fmt::format("          residual: exact, about zero; run: dwell and {:.2f} s of moves ({})\n",
                      sweep.travel.total(), travel_words(sweep.travel));
  text += fmt::format("{:>12} {:>20} {:>18} {:>10} {:>10} {:>13} {:>12}\n", "smoothness", "time price [nm^2/s]",
                      "residual RMS [nm]", "dwell [s]", "run [s]", "h:min:s", "step RMS [s]");
  for (const ParetoPoint& p : sweep.points) {
    if (!p.on_front) continue;
    const double run = p.trade_off.total + sweep.travel.total();
    text +=
        fmt::format("{:>12.4g} {:>20.4g} {:>18.4g} {:>10.2f} {:>10.2f} {:>13} {:>12.4g}\n", p.weights.smoothness,
                    p.weights.time_price, p.exact_rms, p.trade_off.total, run, clock_text(run), p.trade_off.step_rms);
  }
  return text;
}

}  // namespace

int report_pareto(const ParetoSweep& sweep, OutputFolder& folder, const std::string& out, const JsonOption& json) {
  const std::string text = write_pareto(sweep, folder);
  folder.commit();
  finish_progress();
  json.deliver(text, front_text(sweep) + fmt::format("written   {}\n", out));
  return say_limits(sweep.limits);
}

int report_paths(const PathComparison& comparison, OutputFolder& folder, const std::string& out,
                 const JsonOption& json) {
  const std::string text = write_path_comparison(comparison, folder);
  folder.commit();
  finish_progress();
  json.deliver(text, path_comparison_text(comparison) + fmt::format("written   {}, a plan a folder\n", out));
  return say_limits(comparison.limits);
}

}  // namespace dwell::cli
