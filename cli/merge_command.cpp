#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/result_folder.h"
#include "cli/sweep_reports.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "runs/base/json_blocks.h"
#include "runs/base/merged_parts.h"
#include "runs/campaigns/pareto_part.h"
#include "runs/campaigns/path_comparison_output.h"
#include "runs/campaigns/path_part.h"
#include "runs/figure/campaign_part.h"

namespace dwell::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string out;
  JsonOption json;
  ResultFolder folder;

  std::vector<ReadFile> read() const {
    std::vector<ReadFile> files;
    for (const std::string& place : parts) files.push_back({"the part", part_file(place).string()});
    return files;
  }
};

int merge_campaigns(const MergeArguments& a, const MergedParts& parts) {
  if (!a.out.empty())
    throw InputError(
        fmt::format("--out '{}': dwell {} prints its result, and writes no folder; required none "
                    "(--json=FILE.json writes it to a file)",
                    a.out, parts.command));
  const MergedCampaigns merged = merged_campaigns(parts);
  a.json.deliver(json_text(campaign_json(merged.question, merged.samples)),
                 campaign_text(merged.question, merged.samples));
  return kDone;
}

/// The folder of a command whose result is one.
OutputFolder result_folder(const MergeArguments& a, const MergedParts& parts, const ResultFiles& files) {
  if (a.out.empty())
    throw InputError(fmt::format("--out: required; the folder of what dwell {} writes", parts.command));
  return a.folder.make(a.out, files, a.read());
}

int merge_pareto(const MergeArguments& a, const MergedParts& parts) {
  OutputFolder folder = result_folder(a, parts, pareto_files());
  return report_pareto(merged_pareto(parts), folder, a.out, a.json);
}

int merge_paths(const MergeArguments& a, const MergedParts& parts) {
  OutputFolder folder = result_folder(a, parts, path_comparison_files());
  return report_paths(merged_paths(parts, folder, a.out, terminal_progress()), folder, a.out, a.json);
}

/// A command whose parts can be put together, and what does it.
struct MergeRow {
  const char* command;
  int (*merge)(const MergeArguments&, const MergedParts&);
};

constexpr MergeRow kRows[] = {
    {kCampaignsCommand, merge_campaigns}, {kParetoCommand, merge_pareto}, {kPathsCommand, merge_paths}};

int merge_known(const MergeArguments& a, const MergedParts& merged) {
  for (const MergeRow& row : kRows) {
    if (merged.command == row.command) return row.merge(a, merged);
  }
  throw InputError(
      fmt::format("'{}': a part of dwell {}, which this version cannot merge", a.parts[0], merged.command));
}

int run_merge(const MergeArguments& a) {
  a.json.check(a.read(), a.out);
  std::vector<ReadSweepPart> parts;
  for (const std::string& place : a.parts) parts.push_back(read_sweep_part(place));
  try {
    return merge_known(a, merge_parts(std::move(parts)));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("the parts hold another result than this version makes: {}", error.what()));
  }
}

}  // namespace

void add_merge_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "merge", "put the parts of a sweep together that --shard made: what the command without it prints and writes");
  auto a = std::make_shared<MergeArguments>();
  command->add_option("parts", a->parts, "all parts, each the folder that --out named")->type_name("PART")->required();
  command->add_option("--out", a->out, "folder of the result, of commands that write one")->type_name("FOLDER");
  a->folder.add_to(*command);
  a->json.add_to(*command);
  command->footer(
      "Example:\n"
      "  dwell figure simulate mirror/ --samples 100 --uncertainty tif-rate=15% --shard 1/2 --out parts/1\n"
      "  dwell figure simulate mirror/ --samples 100 --uncertainty tif-rate=15% --shard 2/2 --out parts/2\n"
      "  dwell merge parts/1 parts/2\n"
      "  dwell merge parts/1 parts/2 parts/3 --out paths/\n"
      "The parts must be of one version, of the same options and inputs, and all of them: what differs or is missing "
      "is "
      "said.\n"
      "Exit codes: as of the command that is sharded.");
  command->callback([a, &exit_code] { exit_code = run_merge(*a); });
}

}  // namespace dwell::cli
