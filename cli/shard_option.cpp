#include "cli/shard_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>

#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "runs/campaigns/part_files.h"

namespace dwell::cli {
namespace {

/// "tasks 2, 7 of 12".
std::string tasks_in_words(const SweepPart& part) {
  constexpr std::size_t kMostNamed = 12;
  std::vector<std::size_t> tasks = part.shard.tasks_of(part.tasks);
  if (tasks.empty()) return fmt::format("none of {}", counted(part.tasks, "task"));
  const bool more = tasks.size() > kMostNamed;
  if (more) tasks.resize(kMostNamed);
  return fmt::format("{} {}{} of {}", part.results.size() == 1 ? "task" : "tasks", fmt::join(tasks, ", "),
                     more ? ", ..." : "", part.tasks);
}

}  // namespace

void ShardOption::add_to(CLI::App& command, const std::string& tasks) {
  option_ = command.add_option(
      "--shard", text_,
      "do only the " + tasks +
          " K, K + N, K + 2 N, ... and write them as a part into --out, for dwell merge (docs/scale.md)");
  option_->type_name("K/N");
}

std::optional<Shard> ShardOption::shard() const {
  return option_->count() == 0 ? std::nullopt : std::optional<Shard>(parse_shard(text_));
}

OutputFolder make_part_folder(const ResultFolder& folder, const std::string& out, const Shard& shard,
                              const std::vector<ReadFile>& read) {
  refuse_part_of_another_shard(out, shard);
  return folder.make(out, part_files(), read);
}

int deliver_part(const SweepPart& part, OutputFolder& folder, const std::string& out, const JsonOption& json) {
  const std::string text = sweep_part_text(part);
  folder.write(kPartFile, text);
  folder.commit();
  finish_progress();
  json.deliver(text, fmt::format("part      {} of dwell {}: {}\nwritten   {}\n", to_string(part.shard), part.command,
                                 tasks_in_words(part), out));
  return kDone;
}

}  // namespace dwell::cli
