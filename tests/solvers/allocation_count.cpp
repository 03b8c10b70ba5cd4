#include "tests/solvers/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

// In a file of its own, so that no call is inlined into one half of a pair. Eigen takes its memory by malloc and is not
// seen here; vectors are, where they are members of something that is.
namespace {
std::atomic<long> count{0};
}

void* operator new(std::size_t size) {
  ++count;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace dwell {

long allocation_count() { return count; }

}  // namespace dwell
