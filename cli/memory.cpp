#include "cli/memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace dwell::cli {

void keep_freed_memory() {
  // One heap for arrays of any size (no mapping of their own), never trimmed: see mallopt(3).
  if (mallopt(M_MMAP_MAX, 0) == 0 || mallopt(M_TRIM_THRESHOLD, -1) == 0) return;
  // This takes address space only: the block is allocated, so that the heap reaches that far, marked for huge pages,
  // and freed untouched.
  constexpr std::size_t kReserve = std::size_t{4} << 30;
  void* const reserve = std::malloc(kReserve);
  if (reserve == nullptr) return;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* begin = reserve;
  std::size_t room = kReserve;
  if (std::align(page, kReserve - 2 * page, begin, room) != nullptr)
    madvise(begin, room / page * page, MADV_HUGEPAGE);  // only advice: nothing is lost if the system refuses it
  std::free(reserve);
}

}  // namespace dwell::cli
