#include "core/formats/isolated_reader.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

/// Nothing in it is a default.
MapSource unusual_source() {
  MapSource source;
  source.rows = 2;
  source.cols = 1;
  source.values = {1.5, -2.5};
  source.header.pitch = Point{0.25, 0.5};
  source.header.origin = Point{-3.0, 1.0 / 3.0};
  source.header.unit = "um";
  source.header.history = {"one", "", "three \xc2\xb5m"};
  source.header.pitch_rounding = kSinglePitchRounding;
  source.pitch_hint = "; a hint";
  source.pitch_field = "a field = 3";
  source.unclear_origin = "xmin = 4";
  source.camera_pixel = {7.0, -8.0};
  return source;
}

void expect_same(const MapSource& read, const MapSource& made) {
  EXPECT_EQ(read.rows, made.rows);
  EXPECT_EQ(read.cols, made.cols);
  EXPECT_EQ(read.values, made.values);
  EXPECT_EQ(read.header.pitch, made.header.pitch);
  EXPECT_EQ(read.header.origin, made.header.origin);
  EXPECT_EQ(read.header.unit, made.header.unit);
  EXPECT_EQ(read.header.history, made.header.history);
  EXPECT_EQ(read.header.pitch_rounding, made.header.pitch_rounding);
  EXPECT_EQ(read.pitch_hint, made.pitch_hint);
  EXPECT_EQ(read.pitch_field, made.pitch_field);
  EXPECT_EQ(read.unclear_origin, made.unclear_origin);
  EXPECT_EQ(read.camera_pixel, made.camera_pixel);
}

// A field that stays behind, as pitch_rounding once did, is a value that another part of the program then makes up.
TEST(IsolatedReader, PassesOnEveryFieldOfAMap) {
  expect_same(read_isolated(unusual_source, 100, "the test file", "map a"), unusual_source());
  const auto bare = [] {
    MapSource source;
    source.rows = source.cols = 1;
    source.values = {0.0};
    return source;
  };
  expect_same(read_isolated(bare, 100, "the test file", "map a"), bare());
}

}  // namespace
}  // namespace dwell
