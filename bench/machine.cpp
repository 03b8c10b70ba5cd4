#include "bench/machine.h"

#include <fftw3.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace dwell::bench {
namespace {

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  return CPU_COUNT(&set);
}

}  // namespace

Computer this_machine() {
  Computer m;
  m.processor = processor_name();
  m.cores = usable_cores();
  m.memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 0x1p30;
  m.compiler = fmt::format("g++ {}", __VERSION__);
  m.flags = DWELL_BENCH_FLAGS;
  m.commit = DWELL_BENCH_COMMIT;
  m.fftw = fftw_version;
  m.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return m;
}

}  // namespace dwell::bench
