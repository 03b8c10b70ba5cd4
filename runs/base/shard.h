#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dwell {

/// A share of the tasks of a sweep, so that several processes do it between them: of the tasks 1, 2, 3, ... those
/// whose number leaves the same remainder as `number` when divided by `count`. Every task is in one of the shards
/// 1 to `count`; with more shards than tasks some are empty.
struct Shard {
  std::size_t number = 1, count = 1;

  bool has(std::size_t task) const { return task % count == number % count; }
  /// Its tasks of 1 to `tasks`, ascending.
  std::vector<std::size_t> tasks_of(std::size_t tasks) const;

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Reads "2/5". Throws InputError of the field `shard`.
Shard parse_shard(const std::string& text);

/// "2/5".
std::string to_string(const Shard& shard);

}  // namespace dwell
