#include "core/formats/hdf5_packing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/hdf5_map.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::Hdf5TestFile;

/// A data set of 1 x n of a stored type, with attributes that are added.
template <class Add>
MapSource read_packed(const std::vector<double>& stored, hid_t type, Add add, hid_t creation = H5P_DEFAULT) {
  Hdf5TestFile file;
  file.data_set("/z", {1, stored.size()}, stored, H5T_NATIVE_DOUBLE, type, creation);
  add(file);
  return parse_hdf5(file.bytes(), "map a.nc");
}

void expect_values(const MapSource& source, const std::vector<double>& expected) {
  ASSERT_EQ(source.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(source.values[i])) << i << ": " << source.values[i];
    } else {
      EXPECT_EQ(source.values[i], expected[i]) << i;
    }
  }
}

TEST(Hdf5Packing, UnpacksAsCfSaysAndSaysSo) {
  const MapSource source = read_packed({10, 20, -32767}, H5T_STD_I16LE, [](auto& f) {
    f.number("/z", "scale_factor", {0.5});
    f.number("/z", "add_offset", {100});
    f.number("/z", "_FillValue", {-32767}, H5T_STD_I16LE);
    f.text("/z", "units", "nm");
  });
  expect_values(source, {105, 110, NAN});
  EXPECT_EQ(
      source.header.history,
      (std::vector<std::string>{"read /z: height = stored x 0.5 + 100, pixels without data: 1 of _FillValue -32767"}));
}

TEST(Hdf5Packing, TakesEveryMarkerOfNoData) {
  expect_values(read_packed({1, 1e20, -5, 7}, H5T_IEEE_F32LE,
                            [](auto& f) {
                              f.number("/z", "_FillValue", {1e20});
                              f.number("/z", "missing_value", {-5, 8});
                            }),
                {1, NAN, NAN, 7});
  expect_values(read_packed({1, -9999}, H5T_IEEE_F64LE, [](auto& f) { f.number("/z", "no_data", {-9999}); }), {1, NAN});
}

TEST(Hdf5Packing, TakesTheFillValueThatWasChosenButNoZero) {
  const auto read = [](double fill) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &fill);
    MapSource source = read_packed(
        {1, 0, -9999}, H5T_IEEE_F64LE, [](auto&) {}, creation);
    H5Pclose(creation);
    return source;
  };
  expect_values(read(-9999), {1, 0, NAN});
  EXPECT_NE(read(-9999).header.history.at(0).find("the data set's fill value -9999"), std::string::npos);
  expect_values(read(0), {1, 0, -9999});
  EXPECT_TRUE(read(0).header.history.empty());
}

TEST(Hdf5Packing, ReadsIntegersThatWereStoredWithAnotherSign) {
  const auto text = [](const char* value) { return [value](auto& f) { f.text("/z", "_Unsigned", value); }; };
  expect_values(read_packed({-1, 5}, H5T_STD_I8LE, text("true")), {255, 5});
  expect_values(read_packed({-1, 5}, H5T_STD_I16LE, text("true")), {65535, 5});
  expect_values(read_packed({255, 5}, H5T_STD_U8LE, text("false")), {-1, 5});
  expect_values(read_packed({-1, 5}, H5T_STD_I8LE, text("false")), {-1, 5});
  test::expect_input_error([&] { read_packed({1}, H5T_STD_I8LE, text("maybe")); },
                           {"_Unsigned", "'maybe'", "true or false"});
}

TEST(Hdf5Packing, CutsAtTheValidRange) {
  expect_values(read_packed({-1, 0, 20, 21}, H5T_STD_I16LE,
                            [](auto& f) {
                              f.number("/z", "valid_range", {0, 20}, H5T_STD_I16LE);
                            }),
                {NAN, 0, 20, NAN});
  expect_values(read_packed({-1, 0, 20}, H5T_IEEE_F64LE, [](auto& f) { f.number("/z", "valid_min", {0}); }),
                {NAN, 0, 20});
  // Of the type of scale_factor and wider than the numbers: a range of heights.
  expect_values(read_packed({1, 2, 3}, H5T_STD_I16LE,
                            [](auto& f) {
                              f.number("/z", "scale_factor", {10});
                              f.number("/z", "valid_max", {20});
                            }),
                {10, 20, NAN});
  expect_values(read_packed({1, 2, 3}, H5T_STD_I16LE,
                            [](auto& f) {
                              f.number("/z", "scale_factor", {10});
                              f.number("/z", "valid_max", {2}, H5T_STD_I16LE);
                            }),
                {10, 20, NAN});
}

TEST(Hdf5Packing, NamesTheAttributeOfWhatItRefuses) {
  const auto refused = [](auto add, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { read_packed({1, 2}, H5T_STD_I16LE, add); }, words);
  };
  refused([](auto& f) { f.number("/z", "scale_factor", {0}); }, {"map a.nc", "scale_factor", "'/z' = 0", "not 0"});
  refused([](auto& f) { f.text("/z", "scale_factor", "two"); }, {"scale_factor", "'two'", "one finite number"});
  refused([](auto& f) { f.number("/z", "add_offset", {NAN}); }, {"add_offset", "nan"});
  refused([](auto& f) { f.number("/z", "add_offset", {1, 2}); }, {"add_offset", "1, 2"});
  refused([](auto& f) { f.text("/z", "_FillValue", "none"); }, {"_FillValue", "'none'", "numbers"});
  refused([](auto& f) { f.number("/z", "valid_range", {5}); }, {"valid_range", "two finite"});
  refused([](auto& f) { f.number("/z", "valid_range", {5, 4}); }, {"valid_range", "5, 4", "smaller number first"});
  refused(
      [](auto& f) {
        f.number("/z", "valid_range", {4, 5}), f.number("/z", "valid_min", {4});
      },
      {"valid_range", "either"});
}

}  // namespace
}  // namespace dwell
