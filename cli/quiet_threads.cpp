#include "cli/quiet_threads.h"

#include <unistd.h>

#include <cstdlib>

namespace dwell::cli {

void start_with_quiet_threads(char** argv) {
  constexpr const char* kPolicy = "OMP_WAIT_POLICY";
  if (std::getenv(kPolicy) != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  // Without the variable set there would be no end of starts.
  if (setenv(kPolicy, "passive", 1) != 0 || std::getenv(kPolicy) == nullptr) return;
  execv("/proc/self/exe", argv);
}

}  // namespace dwell::cli
