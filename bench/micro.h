#pragma once

#include <string>
#include <vector>

namespace dwell::bench {

/// One thing timed by Google Benchmark, over its repetitions.
struct MicroResult {
  std::string name;  // "lattice-apply", "fft-pair", ...
  long size = 0;     // edge of the map [pixels], or points of the path
  int threads = 1;
  int repetitions = 0;
  double seconds = 0.0;  // median wall clock of a call
  double fastest = 0.0, slowest = 0.0;
  /// Over the bare transform pair of the operator's padded size, same threads; 0 = no such pair. The fastest
  /// repetition of both: what else the machine does only adds.
  double over_fft = 0.0;
};

struct MicroOptions {
  bool quick = false;  // maps of 256 and 512 pixels, short repetitions
  int repetitions = 3;
};

/// Times apply and adjoint of every operator and the bare FFTW pair of their padded sizes, and the path planner.
/// Repetitions of all are interleaved in random order, so that a slow spell of the machine hits all alike.
std::vector<MicroResult> run_micro(const MicroOptions& options);

}  // namespace dwell::bench
