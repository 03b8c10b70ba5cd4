#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace dwell {

/// The numbers that bytes hold in this machine's order, wherever they lie in memory; a rest of less than 8 bytes is
/// dropped. By way of a block that stays in the cache, which is cheaper than to clear all of the memory first.
inline std::vector<double> doubles_of(std::string_view bytes) {
  std::array<double, 4096> block;
  std::vector<double> values;
  values.reserve(bytes.size() / sizeof(double));
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), sizeof block);
    std::memcpy(block.data(), bytes.data(), size);
    values.insert(values.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size / sizeof(double)));
    bytes.remove_prefix(size);
  }
  return values;
}

}  // namespace dwell
