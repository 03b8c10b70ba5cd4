#pragma once

#include <cstdint>
#include <unordered_map>

#include "core/base/grid.h"
#include "core/base/random_numbers.h"

namespace dwell {

/// Draws from 0 ... count - 1 in random order, none twice (Fisher and Yates). Memory and cost are those of what is
/// drawn, so that a few pixels of a large map cost nothing for the others.
class RandomDraw {
 public:
  /// count below 2^32.
  RandomDraw(Index count, std::uint64_t seed) : count_(count), random_(seed) {}

  Index left() const { return count_ - drawn_; }
  /// left() must be > 0.
  Index next() {
    const Index place = drawn_ + random_.below(static_cast<std::uint32_t>(left()));
    const Index result = at(place);
    if (place != drawn_) moved_[place] = at(drawn_);
    moved_.erase(drawn_++);
    return result;
  }

 private:
  Index at(Index place) const {
    const auto found = moved_.find(place);
    return found == moved_.end() ? place : found->second;
  }

  Index count_, drawn_ = 0;
  std::unordered_map<Index, Index> moved_;  // places not drawn yet whose number is not their own
  RandomNumbers random_;
};

}  // namespace dwell
