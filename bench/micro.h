#pragma once

#include <string>
#include <vector>

#include "bench/budget.h"

namespace dwell::bench {

/// One thing timed by Google Benchmark, over its repetitions.
struct MicroResult {
  std::string name;  // "lattice-apply", "fft-pair", ...
  long size = 0;     // edge of the map [pixels], or points of the path
  int threads = 1;
  int repetitions = 0;
  double seconds = 0.0;  // median wall clock of a call
  double fastest = 0.0, slowest = 0.0;
  /// Over the bare transform pair of the operator's padded size in double precision, same threads; 0 = no such pair. It
  /// compares the fastest repetitions, because other work of the machine only adds time. A sparse matrix pads nothing,
  /// so it is compared with the pair of the scattered operator, whose place it takes.
  double over_fft = 0.0;
};

struct MicroOptions {
  bool quick = false;  // maps of 256 and 512 pixels, short repetitions
  int repetitions = 3;
};

/// Times apply and adjoint of every operator and the bare FFTW pair of their padded sizes, that pair in single
/// precision as well, the removal of 36 form terms, the radial spectrum, the path planner, the schedules of a
/// machine, and the readers of map files. Repetitions of all are interleaved in random order, so that a slow spell of
/// the machine hits all alike. Starts no repetition after `share` of the budget; a benchmark without any repetition is
/// not in the result.
std::vector<MicroResult> run_micro(const MicroOptions& options, const Budget& budget, double share);

}  // namespace dwell::bench
