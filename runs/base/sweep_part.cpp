#include "runs/base/sweep_part.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

using PartJson = nlohmann::ordered_json;

constexpr const char* kNoPart = "is no part of a sweep; required what a command with `shard` wrote";

/// Layout and version first: another version's part may lack what this one asks for.
void check_origin(const PartJson& json, const std::string& file) {
  if (!json.is_object() || !json.contains("version") || !json.contains("shards"))
    throw InputError(fmt::format("'{}': {}", file, kNoPart));
  if (json["version"] != version() || json["schema"] != kJsonSchema) {
    throw InputError(
        fmt::format("'{}': made by dwell {}; this is dwell {}, and parts are put together by the version "
                    "that made them",
                    file, json["version"].dump(), version()));
  }
}

void check_unchanged(PartJson json, const std::string& file) {
  const std::string hash = json.value("sha256", "");
  json.erase("sha256");
  if (hash == sha256_of(json_text(std::move(json)))) return;
  throw InputError(fmt::format("'{}': is another than when it was written (its SHA-256 says so)", file));
}

/// Counts on from task to task: a wrong number of them must not ask for memory.
void check_tasks(const PartJson& results, const SweepPart& part, const std::string& file) {
  std::size_t next = part.shard.number;
  bool right = results.is_array();
  for (const PartJson& result : results) {
    right = right && result.at("task") == next && next <= part.tasks;
    next += part.shard.count;
  }
  if (right && next > part.tasks) return;
  throw InputError(
      fmt::format("'{}': does not hold the tasks of shard {} of {}", file, to_string(part.shard), part.tasks));
}

/// Throws nlohmann's exception or InputError unless these are a shard's numbers.
Shard shard_of(const PartJson& json) {
  return parse_shard(fmt::format("{}/{}", json.at("shard").dump(), json.at("shards").dump()));
}

}  // namespace

std::string sweep_part_text(const SweepPart& part) {
  PartJson json = json_of_command(part.command);
  json["shard"] = part.shard.number;
  json["shards"] = part.shard.count;
  json["tasks"] = part.tasks;
  json["asked"] = part.asked;
  PartJson results = PartJson::array();
  const std::vector<std::size_t> tasks = part.shard.tasks_of(part.tasks);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    results.push_back({{"task", tasks[k]}, {"result", part.results.at(k)}});
  json["results"] = std::move(results);
  json["sha256"] = sha256_of(json_text(json));
  return json_text(std::move(json));
}

SweepPart parse_sweep_part(const std::string& text, const std::string& file) {
  PartJson json = PartJson::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError(fmt::format("'{}': {}", file, kNoPart));
  check_origin(json, file);
  try {
    check_unchanged(json, file);
    SweepPart part{json.at("command"), shard_of(json), json.at("tasks"), json.at("asked"), {}};
    check_tasks(json.at("results"), part, file);
    for (PartJson& result : json.at("results")) part.results.push_back(std::move(result.at("result")));
    return part;
  } catch (const PartJson::exception&) {
    throw InputError(fmt::format("'{}': {}", file, kNoPart));
  }
}

std::filesystem::path part_file(const std::string& place) {
  std::error_code unknown;
  const std::filesystem::path file(place);
  return std::filesystem::is_directory(file, unknown) ? file / kPartFile : file;
}

ReadSweepPart read_sweep_part(const std::string& place) {
  const std::filesystem::path file = part_file(place);
  return {place, file.parent_path(), parse_sweep_part(read_whole_file(file), file.string())};
}

}  // namespace dwell
