#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/number_option.h"
#include "cli/result_folder.h"
#include "cli/shard_option.h"
#include "cli/standard_streams.h"
#include "cli/sweep_reports.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "paths/path_catalogue.h"
#include "runs/campaigns/path_comparison_output.h"
#include "runs/campaigns/path_part.h"
#include "runs/job/path_list.h"

namespace dwell::cli {
namespace {

using Words = std::vector<std::string>;

struct PathsArguments {
  std::unique_ptr<JobArguments> job;
  std::string list;
  std::optional<double> pitch;
  ShardOption shard;
  JsonOption json;
  ResultFolder folder;
  bool kinds = false;
};

void print_kinds() {
  for (const PathRecord& kind : path_catalogue()) {
    print(fmt::format("{}:{}\n    {}\n", kind.name, kind.usage, kind.about));
  }
}

int run_paths(const PathsArguments& arguments) {
  if (arguments.kinds) {
    print_kinds();
    return kDone;
  }
  const JobOptions options = arguments.job->options();
  const bool none = arguments.list.empty();
  JobArguments::require(options, {"map", "tif", "out"}, none ? Words{"--paths"} : Words{});
  if (none) throw InputError("--paths: required; for instance raster,spiral,random (--kinds lists all)");
  std::vector<ReadFile> read = arguments.job->files_read(options);
  for (const ListedPath& path : parse_path_list(arguments.list, arguments.pitch.value_or(1.0))) {
    const PathSpec spec = parse_path_spec(path.text);
    if (const auto* file = spec.get_if<PathFromFile>()) read.push_back({"the path", file->file.string()});
  }
  arguments.json.check(read, options.out);
  if (const auto shard = arguments.shard.shard()) {
    OutputFolder part = make_part_folder(arguments.folder, options.out, *shard, read);
    const PathComparison mine = plan_paths(options, arguments.list, arguments.pitch, *shard, part, terminal_progress());
    return deliver_part(path_part(mine, *shard, part), part, options.out, arguments.json);
  }
  OutputFolder folder = arguments.folder.make(options.out, path_comparison_files(), read);
  return report_paths(compare_paths(options, arguments.list, arguments.pitch, folder, terminal_progress()), folder,
                      options.out, arguments.json);
}

std::vector<std::string> flags_but_path() {
  std::vector<std::string> flags = every_flag();
  std::erase(flags, "path");
  std::erase(flags, "tool");
  return flags;
}

}  // namespace

void add_paths_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("paths", "compare paths on a part: plan all, one table, the Pareto set marked");
  auto arguments = std::make_shared<PathsArguments>();
  arguments->job = std::make_unique<JobArguments>(*command, flags_but_path(), true);
  command
      ->add_option("--paths", arguments->list,
                   "paths as --path of dwell plan takes them, separated by commas, or by semicolons where names of "
                   "files hold commas; a path that says no pitch gets --pitch")
      ->type_name("PATH,...");
  add_number(*command, "--pitch", arguments->pitch, ranges::kPitch,
             "pitch in mm of the paths that say none (default a quarter of the removal function's FWHM)")
      ->type_name("MM");
  arguments->shard.add_to(*command, "paths");
  arguments->folder.add_to(*command);
  arguments->json.add_to(*command);
  command->add_flag("--kinds", arguments->kinds, "list the kinds of path with their options, and stop");
  command->footer(
      "Example:\n"
      "  dwell paths --map mirror.csv --map-pixel 0.0938 --tif spot.csv --tif-pixel 0.0938 \\\n"
      "              --paths raster,spiral,raster:pitch=0.5,angle=45 --max-feed 3000 --out paths/\n"
      "Each path's plan is whole, in a folder of its name. A job file's path is not used.\n"
      "Exit codes: 0 done, 1 internal fault, 2 bad usage or input, 3 done but a limit was reached or a path could not "
      "be planned, 130 interrupted.");
  command->callback([arguments, &exit_code] { exit_code = run_paths(*arguments); });
}

}  // namespace dwell::cli
