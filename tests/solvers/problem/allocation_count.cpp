#include "tests/solvers/problem/allocation_count.h"

#include <atomic>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DWELL_COUNTS_ALLOCATIONS 1

namespace {
std::atomic<long> count{0};
}

// Not operator new: Eigen calls malloc directly, and its temporaries are what an iteration would allocate.
extern "C" void* __libc_malloc(std::size_t size);  // glibc's own
extern "C" void* malloc(std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#endif

namespace dwell {

long allocation_count() {
#ifdef DWELL_COUNTS_ALLOCATIONS
  return count.load();
#else
  return -1;
#endif
}

}  // namespace dwell
