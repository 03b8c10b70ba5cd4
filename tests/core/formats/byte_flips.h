#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "core/base/errors.h"
#include "core/formats/map_source.h"

namespace dwell::test {

/// What a reader makes of damaged bytes must be a map of the size it says, or an InputError that begins with `where`.
inline void expect_map_or_input_error(const std::function<MapSource()>& read, const std::string& where,
                                      const std::string& how) {
  try {
    const MapSource source = read();
    EXPECT_GE(source.rows, 1) << how;
    EXPECT_GE(source.cols, 1) << how;
    EXPECT_EQ(source.values.size(), static_cast<std::size_t>(source.rows * source.cols)) << how;
    if (source.header.pitch) {
      EXPECT_TRUE(source.header.pitch->x > 0.0 && source.header.pitch->y > 0.0) << how;
      EXPECT_TRUE(std::isfinite(source.header.pitch->x) && std::isfinite(source.header.pitch->y)) << how;
    }
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(where)) << how << ": " << error.what();
  }
}

/// Reads `count` copies of `bytes`, each with one to eight bytes of the first `head` changed. The same ones every time.
inline void expect_survives_flips(const std::string& bytes, std::size_t head, int count,
                                  const std::function<MapSource(const std::string&)>& read, const std::string& where) {
  std::mt19937_64 random(20);
  for (int trial = 0; trial < count; ++trial) {
    std::string damaged = bytes;
    std::string how = "trial " + std::to_string(trial) + ", bytes";
    for (std::size_t flips = std::size_t{1} << random() % 4; flips > 0; --flips) {
      const std::size_t at = random() % std::min(head, damaged.size());
      damaged[at] = random() % 4 == 0 ? '\xff' : static_cast<char>(random());
      how += " " + std::to_string(at);
    }
    expect_map_or_input_error([&] { return read(damaged); }, where, how);
  }
}

}  // namespace dwell::test
