#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "cli/json_option.h"
#include "cli/result_folder.h"
#include "runs/base/output_folder.h"
#include "runs/base/sweep_part.h"

namespace dwell::cli {

/// The flag --shard, the same in every command that sweeps: with it a command does its share of the tasks and writes a
/// part for `dwell merge`.
class ShardOption {
 public:
  ShardOption() = default;
  ShardOption(const ShardOption&) = delete;  // the command line holds a reference to it
  ShardOption& operator=(const ShardOption&) = delete;

  /// `tasks` says what they are: "campaigns".
  void add_to(CLI::App& command, const std::string& tasks);

  /// Empty if the command is to do all. Throws InputError.
  std::optional<Shard> shard() const;

 private:
  CLI::Option* option_ = nullptr;
  std::string text_;
};

/// The folder for a part of a sweep: as ResultFolder::make, and refused where it holds the part of another shard.
OutputFolder make_part_folder(const ResultFolder& folder, const std::string& out, const Shard& shard,
                              const std::vector<ReadFile>& read);

/// Writes part.json, puts the folder `out` in place, and prints what was done, or the part. Gives back the exit code.
int deliver_part(const SweepPart& part, OutputFolder& folder, const std::string& out, const JsonOption& json);

}  // namespace dwell::cli
