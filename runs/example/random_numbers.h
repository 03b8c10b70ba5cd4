#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace dwell {

/// Random numbers that are the same with every standard library: the engine is specified to the bit, the
/// distributions of <random> are not.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

  /// Mean 0, variance 1 (Box and Muller 1958; one of the two values is dropped, so that no state is carried).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dwell
