#include "core/base/memory.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace dwell {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kKib = 1024;

std::size_t less(std::size_t a, std::size_t b) { return a > b ? a - b : 0; }

/// The first number in a file of the system; kUnlimited if there is none ("max", or no such file).
std::size_t number_in(const char* file) {
  std::size_t number = 0;
  return std::ifstream(file) >> number ? number : kUnlimited;
}

/// Free memory and swap space of the machine.
std::size_t free_of_machine() {
  std::ifstream lines("/proc/meminfo");
  std::size_t available = kUnlimited, swap = 0, kib = 0;
  for (std::string name, unit; lines >> name >> kib && std::getline(lines, unit);) {
    if (name == "MemAvailable:") available = kib * kKib;
    if (name == "SwapFree:") swap = kib * kKib;
  }
  return available == kUnlimited ? kUnlimited : available + swap;
}

struct Held {
  std::size_t address_space = 0, resident = 0;
};

Held held_by_this_process() {
  std::size_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return {pages * page, resident * page};
}

/// Versions 2 and 1 of control groups, as a container sees its own. What other processes of the group hold is not
/// counted: part of it can be given up.
std::size_t limit_of_group() {
  return std::min(number_in("/sys/fs/cgroup/memory.max"), number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
}

std::size_t limit_of_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  return limit.rlim_cur;
}

}  // namespace

std::size_t address_space_in_use() { return held_by_this_process().address_space; }

std::size_t memory_to_be_had() {
  const Held held = held_by_this_process();
  // What the allocator keeps free is in the address space, but is to be had.
  const std::size_t kept = ::mallinfo2().fordblks;
  const std::size_t space = limit_of_address_space(), group = limit_of_group();
  return std::min({free_of_machine(), group == kUnlimited ? kUnlimited : less(group, held.resident),
                   space == kUnlimited ? kUnlimited : less(space, less(held.address_space, kept))});
}

void require_memory(double bytes, const std::string& what) {
  const auto there = static_cast<double>(memory_to_be_had());
  if (!(bytes > there)) return;
  throw OutOfMemory(fmt::format("{} takes at least {:.2f} GiB of memory, and {:.2f} GiB are to be had", what,
                                bytes / 0x1p30, there / 0x1p30));
}

}  // namespace dwell
