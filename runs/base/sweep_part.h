#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "runs/base/shard.h"

namespace dwell {

/// What one shard of a sweep has come to: all that a report of the whole sweep takes from it.
struct SweepPart {
  std::string command;  // "pareto"
  Shard shard;
  std::size_t tasks = 0;         // of the whole sweep
  nlohmann::ordered_json asked;  // the same in all parts: options, hashes of inputs, what was found before any task
  std::vector<nlohmann::ordered_json> results{};  // of the shard's tasks, ascending
};

/// The name of a part's file in its folder.
inline constexpr const char* kPartFile = "part.json";

/// The part as the text of its file (docs/json.md, "Parts"), with its SHA-256. Bytes that are no UTF-8 are escaped, as
/// in all that is printed.
std::string sweep_part_text(const SweepPart& part);

/// Reads what sweep_part_text wrote; `file` is for messages. Throws InputError for anything else: a text that was
/// changed, another layout or version, other tasks than those of its shard.
SweepPart parse_sweep_part(const std::string& text, const std::string& file);

/// A part and where it was read: a folder with a part.json, or that file.
struct ReadSweepPart {
  std::string place;             // as it was named
  std::filesystem::path folder;  // that it lies in
  SweepPart part;
};

/// The file of the part at a place.
std::filesystem::path part_file(const std::string& place);
ReadSweepPart read_sweep_part(const std::string& place);

}  // namespace dwell
