#include "runs/campaigns/path_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/base/errors.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "runs/base/exact_json.h"
#include "runs/campaigns/compared_path_fields.h"
#include "runs/reports/plan_files.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using TaskJson = nlohmann::ordered_json;

TaskJson files_json(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  TaskJson files = TaskJson::array();
  for (const std::string& name : names) files.push_back({{"file", name}, {"sha256", sha256_of_file(folder / name)}});
  return files;
}

/// The files that the list names as paths, which no summary of a comparison has among its inputs.
TaskJson path_files_json(const PathComparison& comparison) {
  TaskJson files = TaskJson::array();
  for (const ComparedPath& path : comparison.paths) {
    const PathSpec spec = parse_path_spec(path.listed.text);
    const auto* file = spec.get_if<PathFromFile>();
    if (!file) continue;
    std::error_code unknown;
    const bool there = fs::is_regular_file(file->file, unknown);
    files.push_back({{"file", file->file.string()}, {"sha256", there ? sha256_of_file(file->file) : "missing"}});
  }
  return files;
}

/// A folder as summaries name places: absolute, without links or a trailing separator.
fs::path plain_folder(const fs::path& folder) {
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder, unknown), unknown);
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The summary of a plan that moves from a folder to another: what it names is where it was.
std::string moved_summary(const std::string& text, const fs::path& from, const fs::path& to) {
  TaskJson summary = TaskJson::parse(text);
  const fs::path way = with_bytes_of_escapes(summary.at("names_from").get<std::string>());
  const fs::path names = plain_folder(plain_folder(from) / way);
  summary["names_from"] = with_escaped_bytes(names.lexically_relative(plain_folder(to)).string());
  return json_text(std::move(summary));
}

/// Copies the plan of a path, checking every file.
void copy_plan(const TaskJson& files, const fs::path& from, const OutputFolder& to, const fs::path& place,
               const Progress& progress) {
  for (const TaskJson& listed : files) {
    progress.check();
    const auto name = listed.at("file").get<std::string>();
    if (!plan_files().has(name))
      throw InputError(fmt::format("'{}': names '{}', which is no file of a plan", from.string(), name));
    std::string bytes = read_whole_file(from / name);
    if (sha256_of(bytes) != listed.at("sha256").get<std::string>()) {
      throw InputError(
          fmt::format("'{}': is another than when it was written (its SHA-256 says so)", (from / name).string()));
    }
    if (name == plan_files().always) bytes = moved_summary(bytes, from, place);
    to.write(name, bytes);
  }
}

}  // namespace

SweepPart path_part(const PathComparison& comparison, const Shard& shard, const OutputFolder& folder) {
  SweepPart part{kPathsCommand, shard, comparison.paths.size(), sheet_json(comparison.sheet)};
  part.asked["paths"] = comparison.list;
  part.asked["path_files"] = path_files_json(comparison);
  part.asked["pitch_mm"] = exact_json(comparison.pitch);
  part.asked["pitch_given"] = comparison.pitch_given;
  part.asked["before_spectrum"] = exact_json(comparison.before);
  for (const std::size_t task : shard.tasks_of(part.tasks)) {
    const ComparedPath& path = comparison.paths[task - 1];
    TaskJson result = exact_json(path);
    result["files"] = path.failure.empty() ? files_json(folder.path(path.listed.name)) : TaskJson::array();
    part.results.push_back(std::move(result));
  }
  return part;
}

PathComparison merged_paths(const MergedParts& parts, const OutputFolder& folder, const fs::path& out,
                            const Progress& progress) {
  PathComparison comparison;
  comparison.sheet = sheet_of_json(parts.asked);
  comparison.list = parts.asked.at("paths");
  comparison.pitch = exact_number(parts.asked.at("pitch_mm"));
  comparison.pitch_given = parts.asked.at("pitch_given");
  read_exact(parts.asked.at("before_spectrum"), comparison.before);
  comparison.paths.resize(parts.results.size());
  const std::vector<ListedPath> list = parse_path_list(comparison.list, comparison.pitch);
  for (std::size_t k = 0; k < parts.results.size(); ++k) {
    ComparedPath& path = comparison.paths[k];
    read_exact(parts.results[k], path);
    path.listed = list.at(k);
  }
  conclude(comparison);
  for (std::size_t k = 0; k < parts.results.size(); ++k) {
    const ComparedPath& path = comparison.paths[k];
    if (!path.failure.empty()) continue;
    progress.report(fmt::format("copying plan {} of {}, {}", k + 1, parts.results.size(), path.listed.name));
    OutputFolder plan(folder.path(path.listed.name), plan_files());
    copy_plan(parts.results[k].at("files"), parts.folders[k] / path.listed.name, plan, out / path.listed.name,
              progress);
    plan.commit();
  }
  return comparison;
}

}  // namespace dwell
