#include "runs/reports/recorded_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/base/errors.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "core/formats/map_name.h"
#include "runs/job/job_file.h"
#include "runs/reports/program_record.h"

namespace dwell {
namespace {

/// The summary, which must be one of `dwell plan`.
nlohmann::json summary_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  const std::string name = folder.string();
  if (!std::filesystem::exists(folder)) {
    throw InputError(
        fmt::format("{}: No such file or directory; required the folder of a plan (dwell plan --out)", name));
  }
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(
        fmt::format("{}: is a file; required the folder of a plan (dwell plan --out), or --program for a "
                    "program alone",
                    name));
  }
  if (!std::filesystem::exists(file)) {
    throw InputError(
        fmt::format("{}: is not the folder of a plan, since it holds no summary.json; required a folder "
                    "that dwell plan --out has written",
                    name));
  }
  nlohmann::json summary = nlohmann::json::parse(read_whole_file(file), nullptr, false);
  if (!summary.is_object() || !summary.contains("command") || !summary["command"].is_string()) {
    throw InputError(
        fmt::format("{}: is not a summary of dwell plan; required one, of version 0.2 or later", file.string()));
  }
  if (const std::string command = summary["command"]; command != "plan") {
    throw InputError(fmt::format("{}: is the result of dwell {}; required that of dwell plan", name, command));
  }
  return summary;
}

std::string text_of(const nlohmann::json& object, const std::string& key, const std::string& file) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string()) return *found;
  throw InputError(fmt::format("{}: {} is missing or no text; required it in a plan's summary", file, key));
}

/// A name as seen from the current folder.
std::string seen_from(const std::filesystem::path& folder, const std::string& name) {
  return folder.empty() ? name : (folder / name).lexically_normal().string();
}

/// A name as the system has it, in a folder: a summary holds bytes that are no UTF-8 as \xE9, unless a file is called
/// so.
std::string name_of(const std::filesystem::path& folder, const std::string& text) {
  std::error_code unknown;
  const bool escaped = text.find("\\x") != std::string::npos;
  const bool is_there = escaped && std::filesystem::exists(seen_from(folder, split_map_name(text).file), unknown);
  return !escaped || is_there ? text : with_bytes_of_escapes(text);
}

/// The folder from which the names of files in a summary are seen; empty: the current one.
std::filesystem::path folder_of_names(const nlohmann::json& summary, const std::filesystem::path& folder) {
  const auto way = summary.find("names_from");
  if (way == summary.end() || !way->is_string()) return {};
  const std::filesystem::path from = (folder / way->get<std::string>()).lexically_normal();
  const nlohmann::json inputs = summary.value("inputs", nlohmann::json::array());
  const bool any = std::any_of(inputs.begin(), inputs.end(), [&from](const nlohmann::json& input) {
    const std::string file = input.is_object() ? input.value("file", "") : "";
    return !file.empty() && std::filesystem::exists(from / split_map_name(name_of(from, file)).file);
  });
  return any && from != "." ? from : std::filesystem::path();
}

JobOptions options_of(const nlohmann::json& summary, const std::string& file, const std::filesystem::path& names) {
  JobOptions options;
  const auto recorded = summary.find("options");
  if (recorded == summary.end() || !recorded->is_object()) {
    throw InputError(fmt::format("{}: holds no options; required them in a plan's summary", file));
  }
  for (const auto& option : recorded->items()) {
    const std::string& key = option.key();
    const auto& table = job_option_table();
    const auto record = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.key == key; });
    if (record == table.end()) {
      throw InputError(
          fmt::format("{}: options.{} is not known to this version of dwell, and may change the result; "
                      "required the version that made the plan",
                      file, key));
    }
    const std::string source = fmt::format("{}: options.{}", file, key);
    const std::string value = name_of(names, text_of(*recorded, key, file));
    set_job_option(options, *record, names.empty() ? value : rebased_option(*record, value, names, source), source);
  }
  return options;
}

/// A map that lies in the plan's own folder, as that of a rest, is found there when the folder was moved.
void find_own_map(RecordedPlan& plan) {
  std::error_code unknown;
  for (InputFile& input : plan.inputs) {
    const std::filesystem::path own = plan.folder / std::filesystem::path(input.file).filename();
    if (input.role != "map" || plan.options.map != input.file) continue;
    if (std::filesystem::exists(input.file, unknown) || !std::filesystem::exists(own, unknown)) continue;
    if (sha256_of_file(own) != input.sha256) continue;
    plan.options.map = input.file = own.string();
  }
}

std::string flag_of_role(const std::string& role) {
  if (role == "profile") return "line-profile";
  const bool own = role == "map" || role == "tif" || role == "machine" || role == "weight" || role == "removal";
  return own ? role : "map-steps";
}

}  // namespace

RecordedPlan read_recorded_plan(const std::filesystem::path& folder) {
  const nlohmann::json summary = summary_of(folder);
  const std::string file = (folder / "summary.json").string();
  const std::filesystem::path names = folder_of_names(summary, folder);
  RecordedPlan plan{folder, options_of(summary, file, names), {}, {}, {}};
  const nlohmann::json program = summary.value("program", nlohmann::json::object());
  plan.program_sha256 = text_of(program, "sha256", file);
  plan.program_file = text_of(program, "file", file);
  if (std::filesystem::path(plan.program_file).filename() != plan.program_file)
    throw InputError(
        fmt::format("{}: program.file = \"{}\"; required a name in the plan's folder", file, plan.program_file));
  const auto inputs = summary.find("inputs");
  if (inputs == summary.end() || !inputs->is_array()) {
    throw InputError(fmt::format("{}: holds no inputs; required them in a plan's summary", file));
  }
  for (const nlohmann::json& input : *inputs) {
    plan.inputs.push_back({text_of(input, "role", file), seen_from(names, name_of(names, text_of(input, "file", file))),
                           text_of(input, "sha256", file)});
  }
  find_own_map(plan);
  return plan;
}

void check_recorded_inputs(const RecordedPlan& plan, const std::set<std::string>& given) {
  if (!given.contains("program") && sha256_of_file(plan.program()) != plan.program_sha256) {
    throw InputError(
        fmt::format("{}: is not the program that the plan was made with: its SHA-256 was {}; required the same, or "
                    "--program {} to take it as it is now",
                    plan.program().string(), short_hash(plan.program_sha256), plan.program().string()));
  }
  for (const InputFile& input : plan.inputs) {
    const std::string flag = flag_of_role(input.role);
    if ((is_of_program_alone(input.role) && input.role != "machine") || given.contains(flag)) continue;
    const std::filesystem::path file = split_map_name(input.file).file;
    if (!std::filesystem::exists(file)) {
      throw InputError(
          fmt::format("{}: the file of the plan's --{} is not there (the plan names it {} the folder in "
                      "which dwell plan ran, which was looked for beside the plan as it lay then, and the current "
                      "one); required it, or --{} with the file to take in its place",
                      input.file, flag, file.is_absolute() ? "in full, whatever" : "as seen from", flag));
    }
    const std::string now = sha256_of_file(file);
    if (now == input.sha256) continue;
    throw InputError(
        fmt::format("{}: has changed since the plan {} was made: its SHA-256 is {}, and was {}; required "
                    "the same file, or --{} {} to take it as it is now",
                    input.file, plan.folder.string(), short_hash(now), short_hash(input.sha256), flag,
                    flag == "map-steps" ? "with the steps" : input.file));
  }
}

}  // namespace dwell
