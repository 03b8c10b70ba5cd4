#pragma once

#include <algorithm>

#include "core/removal_operator.h"

namespace dwell {

/// Calls body(block, begin, length) for stretches of at most kBlock of 0..n, in parallel where that pays. What is
/// summed by block and then over the blocks in order has the same bytes for any number of threads.
inline constexpr Index kBlock = 1024;

inline Index block_count(Index n) { return (n + kBlock - 1) / kBlock; }

template <class Body>
void for_blocks(Index n, int threads, const Body& body) {
  const Index count = block_count(n);
  constexpr Index kWorthThreads = 16;  // blocks; below that, waking a thread costs more than it saves
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1 && count >= kWorthThreads)
  for (Index b = 0; b < count; ++b) body(b, b * kBlock, std::min(kBlock, n - b * kBlock));
}

}  // namespace dwell
