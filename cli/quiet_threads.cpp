#include "cli/quiet_threads.h"

#include <unistd.h>

#include <cstdlib>

namespace dwell::cli {

void start_with_quiet_threads(char** argv) {
  constexpr const char* kPolicy = "OMP_WAIT_POLICY";
  if (std::getenv(kPolicy) != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  // If the variable could not be set, the program would start itself again without end.
  if (setenv(kPolicy, "passive", 1) != 0 || std::getenv(kPolicy) == nullptr) return;
  execv("/proc/self/exe", argv);
}

}  // namespace dwell::cli
