#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace dwell {

/// Reads bytes as doubles in this machine's byte order. The bytes need no alignment; fewer than 8 left over at the end
/// are dropped. Values pass through a block that stays in the cache, because that is cheaper than clearing the whole
/// vector before it is filled.
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
