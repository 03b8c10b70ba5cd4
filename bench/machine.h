#pragma once

#include <string>

namespace dwell::bench {

/// The machine and program that made a measurement: everything that can change its numbers.
struct Computer {
  std::string processor;  // as the kernel names it
  int cores = 0;          // that this process may use
  double memory = 0.0;    // [GiB]
  std::string compiler;
  std::string flags;
  std::string commit;  // of the sources when the build was configured; "-dirty" if they differed from it
  std::string fftw;
  std::string date;  // UTC
};

/// The machine that this process runs on.
Computer this_machine();

}  // namespace dwell::bench
