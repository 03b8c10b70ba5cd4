#include "core/base/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace dwell {
namespace {

TEST(Memory, ToBeHadIsNoMoreThanTheMachineHas) {
  double all = 0.0, kib = 0.0;
  std::ifstream lines("/proc/meminfo");
  for (std::string name, unit; lines >> name >> kib && std::getline(lines, unit);) {
    if (name == "MemTotal:" || name == "SwapTotal:") all += 1024.0 * kib;
  }
  const auto there = static_cast<double>(memory_to_be_had());
  EXPECT_GT(there, 1e6);  // this test runs
  EXPECT_LE(there, all);
}

TEST(Memory, IsRefusedBeforeItIsTaken) {
  EXPECT_NO_THROW(require_memory(1e6, "a small plan"));
  try {
    require_memory(1e18, "a plan of 5 pixels");
    FAIL() << "a thousand million GiB were to be had";
  } catch (const OutOfMemory& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find("a plan of 5 pixels takes at least 931322574.62 GiB of memory, and "), 0u) << what;
    EXPECT_NE(what.find(" GiB are to be had"), std::string::npos) << what;
  }
}

/// 7 if a limit of the address space is seen.
[[maybe_unused]] int limit_this_process() {
  constexpr rlim_t kMiB = rlim_t{1} << 20, kWide = 20'000 * kMiB, kNarrow = 2'000 * kMiB;
  const rlimit wide{kWide, kWide}, narrow{kNarrow, kWide};
  if (::setrlimit(RLIMIT_AS, &wide) != 0) return 1;
  const std::size_t before = memory_to_be_had();
  if (::setrlimit(RLIMIT_AS, &narrow) != 0) return 2;
  const std::size_t there = memory_to_be_had();
  return there < kNarrow && there <= before ? 7 : 3;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// A limit holds for a whole process, so the case is one of its own.
TEST(Memory, ToBeHadIsBelowTheLimitOfTheAddressSpace) {
  EXPECT_EXIT(_exit(limit_this_process()), testing::ExitedWithCode(7), "");
}
#endif

}  // namespace
}  // namespace dwell
