#include "core/formats/hdf5_fields.h"

#include <gtest/gtest.h>

#include "core/formats/hdf5_map.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::Hdf5TestFile;

/// What is read of a map of 2 x 3 in a file to which more is added.
template <class Add>
MapSource read_with(Add add, const std::string& path = "/run/z") {
  Hdf5TestFile file;
  file.doubles(path, {2, 3}, {1, 2, 3, 4, 5, 6});
  add(file);
  return parse_hdf5_at(file.bytes(), path, "map a.h5");
}

template <class Add>
void refused(Add add, std::initializer_list<std::string> words) {
  test::expect_input_error([&] { read_with(add); }, words);
}

TEST(Hdf5Fields, AUnitMayHaveOtherNamesAndPlaces) {
  EXPECT_EQ(read_with([](auto& f) { f.text("/run/z", "units", "um"); }).header.unit, "um");
  EXPECT_EQ(read_with([](auto& f) { f.text("/run/z", "Z Unit", "microns"); }).header.unit, "microns");
  EXPECT_EQ(read_with([](auto& f) { f.text("/run/z", "long_name", "height [um]"); }).header.unit, "um");
  EXPECT_EQ(read_with([](auto& f) { f.text("/run", "units", "um"); }).header.unit, "um") << "of the group";
  EXPECT_EQ(read_with([](auto& f) { f.text("/", "units", "um"); }).header.unit, "um") << "of the file";
  EXPECT_EQ(read_with([](auto& f) { f.text_set("/run/units", "um"); }).header.unit, "um") << "beside it";
  EXPECT_EQ(read_with([](auto&) {}, "/run/heights_um").header.unit, "um") << "in its name";
  EXPECT_EQ(read_with([](auto&) {}, "/run/heights_waves").header.unit, "waves");
  EXPECT_FALSE(read_with([](auto&) {}, "/run/map_m1").header.unit);
  const MapSource nearest = read_with([](auto& f) { f.text("/run/z", "unit", "nm"), f.text("/", "units", "um"); });
  EXPECT_EQ(nearest.header.unit, "nm");
  refused([](auto& f) { f.text("/run/z", "unit", "nm"), f.text("/run/z", "units", "um"); },
          {"attribute unit of HDF5 data set '/run/z' = 'nm'", "attribute units", "agree"});
}

TEST(Hdf5Fields, AWordOfAUnitIsUnderstoodOrRefusedByName) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& unit) {
    Hdf5TestFile file;
    file.doubles("/z", {1, 2}, {1, 2});
    file.number("/z", "pitch_mm", {0.5});
    file.text("/z", "units", unit);
    MapReadOptions options;
    options.scale = 1e3;
    return read_map(folder.file("a.h5", file.bytes()), options).at(0, 1);
  };
  for (const char* unit : {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "Micrometers"}) EXPECT_EQ(read(unit), 2e3) << unit;
  test::expect_input_error([&] { read("nm"); }, {"a.h5", "unit nm", "`map unit`"});
  test::expect_input_error([&] { read("waves"); }, {"a.h5", "unit waves", "`wavelength`", "`wave scale`"});
  test::expect_input_error([&] { read("radians"); }, {"a.h5", "'radians'", "accepted: nm, um, mm, m"});
}

TEST(Hdf5Fields, APitchMayHaveOtherNamesAndPlaces) {
  const auto pitch = [](auto add) { return read_with(add).header.pitch; };
  EXPECT_EQ(pitch([](auto& f) { f.number("/run/z", "pixel_size_mm", {0.5}); }), (Point{0.5, 0.5}));
  EXPECT_EQ(pitch([](auto& f) { f.number("/run/z", "pitch", {500}), f.text("/run/z", "pitch_units", "um"); }),
            (Point{0.5, 0.5}));
  EXPECT_EQ(pitch([](auto& f) { f.doubles("/run/dx_mm", {1}, {0.5}), f.doubles("/run/dy_mm", {1}, {0.25}); }),
            (Point{0.5, 0.25}));
  EXPECT_EQ(pitch([](auto& f) { f.text("/", "pixel pitch", "0.5 mm"); }), (Point{0.5, 0.5}));
  const MapSource open = read_with([](auto& f) { f.number("/run/z", "pixel_size", {0.5}); });
  EXPECT_FALSE(open.header.pitch);
  EXPECT_NE(open.pitch_hint.find("attribute pixel_size of HDF5 data set '/run/z' = 0.5"), std::string::npos);
}

TEST(Hdf5Fields, WhatMayBeAnOriginNeedsAWord) {
  const test::TemporaryFolder folder;
  Hdf5TestFile file;
  file.doubles("/z", {1, 2}, {1, 2});
  file.number("/z", "pitch_mm", {0.5});
  file.number("/z", "x_offset", {12.0});
  const auto path = folder.file("a.h5", file.bytes());
  test::expect_input_error([&] { read_map(path); },
                           {"a.h5", "x_offset", "12", "`map origin`", "0,0 if it does not matter"});
  MapReadOptions options;
  options.origin = Point{12.0, 0.0};
  EXPECT_EQ(read_map(path, options).grid.origin, (Point{12.0, 0.0}));
}

TEST(Hdf5Fields, ATextMaySayWhatNoNameSays) {
  EXPECT_EQ(read_with([](auto& f) { f.text("/run/z", "quantity", "um"); }).header.unit, "um");
  const test::TemporaryFolder folder;
  for (const char* where : {"/z", "/"}) {
    Hdf5TestFile file;
    file.doubles("/z", {1, 2}, {1, 2});
    file.number("/z", "pitch_mm", {0.5});
    file.text(where, "comment", "amplitude in um");
    const auto path = folder.file("a.h5", file.bytes());
    test::expect_input_error([&] { read_map(path); }, {"a.h5", "attribute comment", "'amplitude in um'", "`map unit`"});
    MapReadOptions options;
    options.scale = 1e3;
    EXPECT_EQ(read_map(path, options).at(0, 1), 2e3) << where;
  }
}

TEST(Hdf5Fields, AFactorIsRefusedByName) {
  refused([](auto& f) { f.number("/run/z", "z_scale", {1e-3}); }, {"attribute z_scale", "0.001", "required"});
  refused([](auto& f) { f.number("/", "z_factor", {2}); }, {"attribute z_factor of HDF5 group '/'", "2"});
}

}  // namespace
}  // namespace dwell
