#include "runs/campaigns/part_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "runs/reports/plan_files.h"

namespace dwell {

const ResultFiles& part_files() {
  static const ResultFiles kFiles{"part of a sweep", kPartFile, {}, {}, &plan_files()};
  return kFiles;
}

void refuse_part_of_another_shard(const std::string& folder, const Shard& shard) {
  const std::filesystem::path file = std::filesystem::path(folder) / kPartFile;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return;
  const auto json = nlohmann::json::parse(read_whole_file(file), nullptr, false);
  if (!json.is_object() || !json.contains("shard") || !json.contains("shards")) return;
  if (json["shard"] == shard.number && json["shards"] == shard.count) return;
  throw InputError("out", folder, "a folder of its own for every shard",
                   fmt::format("`out`: '{}' holds the part of shard {}/{}, which that of {} would replace; give every "
                               "shard a folder of its own",
                               folder, json["shard"].dump(), json["shards"].dump(), to_string(shard)));
}

}  // namespace dwell
