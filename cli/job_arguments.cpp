#include "cli/job_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/errors.h"
#include "core/formats/map_name.h"
#include "runs/job/input_files.h"
#include "runs/job/job_file.h"
#include "runs/job/keep_out_option.h"
#include "runs/job/line_profile_map.h"
#include "runs/job/pixel_weight_option.h"
#include "runs/job/tool_option.h"
#include "runs/machine/machine_option.h"
#include "runs/map_steps/map_steps.h"
#include "runs/programs/shipped_templates.h"

namespace dwell::cli {

std::vector<std::string> every_flag() {
  std::vector<std::string> flags;
  for (const JobOptionRecord& record : job_option_table()) flags.push_back(record.flag);
  return flags;
}

JobArguments::JobArguments(CLI::App& command, const std::vector<std::string>& flags, bool with_job) {
  if (with_job) {
    command.add_option("--job", job_, "job file (TOML); options on the command line come on top of it")
        ->type_name("FILE");
  }
  const JobOptions defaults;
  for (const JobOptionRecord& record : job_option_table()) {
    if (std::find(flags.begin(), flags.end(), record.flag) == flags.end()) continue;
    const std::string fallback = record.get(defaults);
    const std::string help = fallback.empty() ? record.help : fmt::format("{} (default {})", record.help, fallback);
    CLI::Option* option = command.add_option("--" + record.flag, help)->type_name(record.value);
    takes_tools_ = takes_tools_ || record.flag == "tool";
    given_.push_back({&record, record.alone.empty() ? option->expected(1) : option->expected(0, 1)});
    if (record.takes_list || record.repeats) option->take_all();  // its parts or lines follow one another
  }
}

JobOptions JobArguments::options() const {
  JobOptions options;
  if (!job_.empty()) read_job_file(job_, options);
  if (!takes_tools_) refuse_tools(options, "this command");
  return options_over(std::move(options));
}

JobOptions JobArguments::options_over(JobOptions options) const {
  for (const Given& given : given_) {
    if (given.option->count() == 0) continue;
    if (given.record->flag == "map") forget_line_profile(options);
    if (given.record->flag == "line-profile") forget_map(options);
  }
  for (const Given& given : given_) {
    if (given.option->count() == 0) continue;
    std::string text = fmt::format("{}", fmt::join(given.option->results(), given.record->repeats ? "\n" : ";"));
    const bool is_alone = text.empty() || text == "true";  // as CLI11 has it
    if (is_alone && !given.record->alone.empty()) text = given.record->alone;
    set_job_option(options, *given.record, text, "--" + given.record->flag);
  }
  // A map takes the place of the job's removal, and the other way round.
  const auto is_given = [this](const char* flag) {
    return std::any_of(given_.begin(), given_.end(),
                       [flag](const Given& g) { return g.record->flag == flag && g.option->count() > 0; });
  };
  if (is_given("removal") && !is_given("map")) options.map.clear();
  if (is_given("map") && !is_given("removal")) options.removal.clear();
  return options;
}

void JobArguments::require(const JobOptions& options, const std::vector<std::string>& flags,
                           const std::vector<std::string>& others) {
  std::vector<std::string> missing;
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.flag == "map" && !options.line_profile.empty()) continue;  // which takes its place
    const bool wanted = std::find(flags.begin(), flags.end(), record.flag) != flags.end();
    if (record.flag == "map" && !options.removal.empty()) continue;  // takes its place
    if (wanted && record.get(options).empty()) missing.push_back("--" + record.flag);
  }
  missing.insert(missing.end(), others.begin(), others.end());
  if (!missing.empty()) {
    const std::vector<std::string> pitches = missing_pitches(options);
    missing.insert(missing.end(), pitches.begin(), pitches.end());
  }
  if (missing.size() < 2) return;
  throw InputError(fmt::format("{}: required; --help says what each is", fmt::join(missing, ", ")));
}

std::vector<const JobOptionRecord*> JobArguments::given() const {
  std::vector<const JobOptionRecord*> records;
  for (const Given& given : given_) {
    if (given.option->count() > 0) records.push_back(given.record);
  }
  return records;
}

namespace {

/// The files that say what a tool is and where it goes.
std::vector<ReadFile> files_of_tool(const JobOptions& options) {
  std::vector<ReadFile> read{{"the removal function", options.tif},
                             {"the machine", is_inline_machine(options.machine) ? "" : options.machine}};
  if (const auto* path = options.path.get_if<PathFromFile>()) read.push_back({"the path", path->file.string()});
  return read;
}

}  // namespace

std::vector<ReadFile> JobArguments::files_read(const JobOptions& options) const {
  std::vector<ReadFile> read{{"the job file", job_},
                             {"the map", options.map},
                             {"the line profile", options.line_profile},
                             {"the removal", options.removal},
                             {"the header", options.header},
                             {"the footer", options.footer},
                             {"the log", split_map_name(options.log).file.string()}};
  if (!options.log_plan.empty())
    read.push_back({"the log's plan", (std::filesystem::path(options.log_plan) / "summary.json").string()});
  if (!options.program_template.empty() && !is_shipped_template(options.program_template))
    read.push_back({"the template", options.program_template});
  for (ReadFile& file : files_of_tool(options)) read.push_back(std::move(file));
  if (!options.tools.empty()) {
    for (const ToolSpec& tool : parse_tool_specs(options.tools)) {
      for (ReadFile& file : files_of_tool(options_of_tool({}, tool))) read.push_back(std::move(file));
    }
  }
  for (const std::string& file : keep_out_files(options.keep_out)) read.push_back({"the zones", file});
  for (const std::string& file : pixel_weight_files(options.weight)) read.push_back({"the weights", file});
  for (const std::string* steps : {&options.map_steps, &options.tif_steps}) {
    for (const std::string& file : map_step_files(*steps)) read.push_back({"a map of a step", file});
  }
  return read;
}

}  // namespace dwell::cli
