#pragma once

#include <cstdint>

#include "core/base/progress.h"

namespace dwell {

/// Asks a Progress once in `every` steps of a loop whether to stop, and throws Interrupted if so: for loops whose steps
/// are too short for a question at each. It holds a reference to the progress.
class Poll {
 public:
  /// The default suits steps of up to a microsecond, of which 65,536 take 0.07 s; longer steps need a smaller number.
  explicit Poll(const Progress& progress, std::uint32_t every = 65536)
      : progress_(progress), every_(every), left_(every) {}

  void step() {
    if (--left_ > 0) return;
    left_ = every_;
    progress_.check();
  }

 private:
  const Progress& progress_;
  std::uint32_t every_, left_;
};

}  // namespace dwell
