#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "runs/base/sweep_part.h"

namespace dwell {

/// All tasks of a sweep, put together from its parts.
struct MergedParts {
  std::string command;
  nlohmann::ordered_json asked;
  std::vector<nlohmann::ordered_json> results;  // of task 1, 2, ...
  std::vector<std::filesystem::path> folders;   // that each task's result was read from
};

/// Puts the parts together. Throws InputError unless they are of one sweep (naming the part and the field that differs,
/// with both values) and every shard is there exactly once (naming those that are missing or come twice).
MergedParts merge_parts(std::vector<ReadSweepPart> parts);

}  // namespace dwell
