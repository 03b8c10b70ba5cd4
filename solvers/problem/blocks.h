#pragma once

#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/grid.h"

namespace dwell {

/// Calls body(block, begin, length) for stretches of at most kBlock of 0..n, in parallel where that pays. A sum taken
/// within each block and then over the blocks in order has the same bytes for any number of threads.
inline constexpr Index kBlock = 1024;

inline Index block_count(Index n) { return (n + kBlock - 1) / kBlock; }

template <class Body>
void for_blocks(Index n, int threads, const Body& body) {
  const Index count = block_count(n);
  constexpr Index kWorthThreads = 16;  // blocks; below that, waking a thread costs more than it saves
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1 && count >= kWorthThreads)
  for (Index b = 0; b < count; ++b) body(b, b * kBlock, std::min(kBlock, n - b * kBlock));
}

/// Sum of part(begin, length) over a fixed number of stretches of 0..n, each by one thread, added up in order: the same
/// bytes for any number of threads, and no allocation.
template <class Part>
double sum_over(Index n, int threads, const Part& part) {
  constexpr Index kParts = 64, kWorthThreads = 16 * kBlock;
  const Index length = (n + kParts - 1) / kParts;
  std::array<double, kParts> sums{};
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1 && n >= kWorthThreads)
  for (Index k = 0; k < kParts; ++k) {
    const Index begin = std::min(k * length, n);
    sums[static_cast<std::size_t>(k)] = part(begin, std::min(length, n - begin));
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace dwell
