#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/progress_line.h"
#include "cli/result_folder.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "core/base/errors.h"
#include "runs/campaigns/pareto_output.h"
#include "runs/reports/aim.h"
#include "runs/reports/map_line.h"
#include "runs/reports/tool_sheet.h"
#include "runs/reports/travel_words.h"

namespace dwell::cli {
namespace {

struct ParetoArguments {
  std::unique_ptr<JobArguments> job;
  std::string smoothnesses, time_prices;
  JsonOption json;
  ResultFolder folder;
};

/// The text for people: the front of the sweep.
std::string front_text(const ParetoSweep& sweep) {
  const Part& part = *sweep.job.part;
  std::string text = map_line(part.map.grid, part.before.valid_pixels) + aim_line(correction_aim(sweep.job)) +
                     tool_lines(tool_sheet(part.tif));
  const auto on_front =
      std::count_if(sweep.points.begin(), sweep.points.end(), [](const auto& p) { return p.on_front; });
  long applications = 0;
  for (const ParetoPoint& p : sweep.points) applications += p.solver.operator_applications;
  text += fmt::format("solves    {}, {}, {:.2f} s; {} on the Pareto front:\n", sweep.points.size(),
                      counted(applications, "operator application"), sweep.seconds, on_front);
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

int run_pareto(const ParetoArguments& arguments) {
  const JobOptions options = arguments.job->options();
  if (options.blemishes == BlemishHandling::LeaveOut) {
    throw InputError(
        "blemishes = leave-out of the job file: dwell pareto has all pixels in the fit; accepted: report or keep, or "
        "--map-steps 'blemishes:width=MM', which takes them off the map");
  }
  ParetoRanges ranges;
  if (!arguments.smoothnesses.empty())
    ranges.smoothnesses = parse_weight_list(arguments.smoothnesses, "--smoothnesses");
  if (!arguments.time_prices.empty()) ranges.time_prices = parse_weight_list(arguments.time_prices, "--time-prices");
  JobArguments::require(options, {"map", "tif", "path", "out"});
  const std::vector<ReadFile> read = arguments.job->files_read(options);
  arguments.json.check(read, options.out);
  OutputFolder folder = arguments.folder.make(options.out, pareto_files(), read);
  const ParetoSweep sweep = sweep_weights(options, ranges, terminal_progress());
  const std::string json = write_pareto(sweep, folder);
  folder.commit();
  finish_progress();
  arguments.json.deliver(json, front_text(sweep) + fmt::format("written   {}\n", options.out));
  return say_limits(sweep.limits);
}

/// The options of a plan but for the weights, which are swept, and the program, which is not written.
std::vector<std::string> swept_flags() {
  std::vector<std::string> flags = every_flag();
  for (const JobOptionRecord& record : program_option_records()) std::erase(flags, record.flag);
  for (const JobOptionRecord& record : log_option_records()) std::erase(flags, record.flag);
  std::erase_if(flags, [](const std::string& f) {
    return f == "smoothness" || f == "time-price" || f == "time-worth" || f == "certify" || f == "accept" ||
           f == "blemishes" || f == "gcode" || f == "machine" || f == "schedule" || f == "rounds" || f == "export" ||
           f == "template" || f == "uncertainty" || f == "robust-plan";
  });
  return flags;
}

}  // namespace

void add_pareto_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("pareto", "sweep the weights of a plan: residual against total time against smooth feed");
  auto arguments = std::make_shared<ParetoArguments>();
  arguments->job = std::make_unique<JobArguments>(*command, swept_flags(), true);
  command
      ->add_option(
          "--smoothnesses", arguments->smoothnesses,
          "weights of smooth feed: FROM:TO:COUNT in equal ratios, or a list like 0,0.01,0.1 (default 0.001:10:5)")
      ->type_name("WEIGHTS");
  command
      ->add_option(
          "--time-prices", arguments->time_prices,
          "prices of machine time in nm^2/s, likewise (default 0 and four up to a hundredth of the highest that "
          "has any effect)")
      ->type_name("PRICES");
  arguments->folder.add_to(*command);
  arguments->json.add_to(*command);
  command->footer(
      "Example:\n"
      "  dwell pareto --map mirror.csv --map-pixel 0.0938 --tif spot.csv --tif-pixel 0.0938 \\\n"
      "               --path raster:pitch=1 --smoothnesses 0.001:10:7 --time-prices 0,1e-6,1e-5 --out pareto/\n"
      "A job file's smoothness, time_price_nm2_per_s and what it says of program.nc are not used; max_solve_s is for "
      "each solve.\n"
      "Exit codes: 0 done, 1 internal fault, 2 bad usage or input, 3 done but a limit was reached, 130 interrupted.");
  command->callback([arguments, &exit_code] { exit_code = run_pareto(*arguments); });
}

}  // namespace dwell::cli
