#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/base/poll.h"

namespace dwell {

/// Random numbers that are the same with every standard library: the engine is specified to the bit, the distributions
/// and shuffles of <random> are not.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }

  /// A whole number from 0 to count - 1, count >= 1; uniform to count / 2^32.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((engine_() >> 32U) * static_cast<std::uint64_t>(count)) >> 32U);
  }

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

  /// Mean 0, variance 1 (Box and Muller 1958; one of the two values is dropped, so that no state is carried).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
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
  std::mt19937_64 engine_;
};

}  // namespace dwell
