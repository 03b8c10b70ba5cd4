#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "core/map/height_map.h"

namespace dwell::test {

/// Equal to the last bit, NaN where NaN.
inline void expect_same_map(const HeightMap& actual, const HeightMap& expected) {
  EXPECT_EQ(actual.grid.rows, expected.grid.rows);
  EXPECT_EQ(actual.grid.cols, expected.grid.cols);
  EXPECT_EQ(actual.grid.pitch_x, expected.grid.pitch_x);
  EXPECT_EQ(actual.grid.pitch_y, expected.grid.pitch_y);
  EXPECT_EQ(actual.grid.origin.x, expected.grid.origin.x);
  EXPECT_EQ(actual.grid.origin.y, expected.grid.origin.y);
  ASSERT_EQ(actual.values.size(), expected.values.size());
  for (std::size_t i = 0; i < expected.values.size(); ++i) {
    const double a = actual.values[i], b = expected.values[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << "pixel " << i << ": " << a << " != " << b;
  }
}

}  // namespace dwell::test
