#pragma once

#include <memory>

#include "core/base/grid.h"

namespace dwell::bench {

/// The real transform of size x size samples and its inverse in single precision, planned as core/numerics/fft.h plans
/// those in double precision. It shows what half the memory traffic would gain; the operators themselves have no single
/// precision. All samples are zero; a transform takes the same time whatever its input.
class SingleFftPair {
 public:
  SingleFftPair(Index size, int threads);
  ~SingleFftPair();

  void execute();

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace dwell::bench
