#include "runs/base/shard.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr std::size_t kMostShards = 1'000'000;

/// The whole number from 1 to kMostShards that all of the text spells.
std::optional<std::size_t> count_in(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > kMostShards) return {};
  return value;
}

}  // namespace

std::vector<std::size_t> Shard::tasks_of(std::size_t tasks) const {
  std::vector<std::size_t> mine;
  for (std::size_t task = number; task <= tasks; task += count) mine.push_back(task);
  return mine;
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = count_in(std::string_view(text).substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : count_in(std::string_view(text).substr(slash + 1));
  if (!number || !count || *number > *count) {
    throw InputError("shard", "'" + text + "'",
                     fmt::format("K/N with whole numbers, K from 1 to N and N from 1 to {}, as 2/5", kMostShards));
  }
  return {*number, *count};
}

std::string to_string(const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }

}  // namespace dwell
