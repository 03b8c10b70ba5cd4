#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/result_folder.h"
#include "cli/shard_option.h"
#include "cli/sweep_reports.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "runs/campaigns/pareto_part.h"

namespace dwell::cli {
namespace {

struct ParetoArguments {
  std::unique_ptr<JobArguments> job;
  std::string smoothnesses, time_prices;
  ShardOption shard;
  JsonOption json;
  ResultFolder folder;
};

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
  if (const auto shard = arguments.shard.shard()) {
    OutputFolder part = make_part_folder(arguments.folder, options.out, *shard, read);
    const ParetoSweep mine = solve_pairs(options, ranges, *shard, terminal_progress());
    return deliver_part(pareto_part(mine, *shard), part, options.out, arguments.json);
  }
  OutputFolder folder = arguments.folder.make(options.out, pareto_files(), read);
  return report_pareto(sweep_weights(options, ranges, terminal_progress()), folder, options.out, arguments.json);
}

/// The options of a plan but for the weights, which are swept, and the program, which is not written.
std::vector<std::string> swept_flags() {
  std::vector<std::string> flags = every_flag();
  for (const JobOptionRecord& record : program_option_records()) std::erase(flags, record.flag);
  for (const JobOptionRecord& record : log_option_records()) std::erase(flags, record.flag);
  std::erase_if(flags, [](const std::string& f) {
    return f == "tool" || f == "smoothness" || f == "time-price" || f == "time-worth" || f == "certify" ||
           f == "accept" || f == "blemishes" || f == "gcode" || f == "machine" || f == "schedule" || f == "rounds" ||
           f == "export" || f == "template" || f == "uncertainty" || f == "robust-plan";
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
  arguments->shard.add_to(*command, "solves");
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
