#pragma once

#include <cstdint>

#include "core/base/progress.h"

namespace dwell {

/// Asks a Progress whether to stop once in so many steps of a loop, for loops whose steps are too short to ask at each.
/// Throws Interrupted then. Refers to the progress.
class Poll {
 public:
  /// 65,536 steps of up to a microsecond are asked after often enough (progress.h); take fewer for longer steps.
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
