#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/base/poll.h"

namespace dwell {

/// Random numbers that are the same with every standard library (whose distributions and shuffles differ).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}

  std::uint64_t bits() { return generator_(); }

  /// A whole number from 0 to count - 1, count >= 1; uniform to count / 2^32.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((generator_() >> 32) * static_cast<std::uint64_t>(count)) >> 32);
  }

  /// Puts the values in random order (Fisher and Yates); at most 2^32 - 1 values.
  template <class T>
  void shuffle(std::vector<T>& values, const Progress& progress = {}) {
    Poll poll(progress);
    for (std::size_t i = values.size(); i > 1; --i) {
      poll.step();
      std::swap(values[i - 1], values[below(static_cast<std::uint32_t>(i))]);
    }
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace dwell
