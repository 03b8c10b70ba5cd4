#include "core/formats/wave_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::TemporaryFolder;

MapReadOptions with(const WaveOptions& waves) {
  MapReadOptions options;
  options.pitch = Point{0.5, 0.25};
  options.waves = waves;
  return options;
}

/// No number of these is the other's half.
constexpr const char* kValues = "1,-0.25,nan\n0.1,3,0.7\n";

TEST(WaveScale, ValuesInWavesByOptionBecomeHeights) {
  const TemporaryFolder folder;
  const auto file = folder.file("a.csv", kValues);
  const HeightMap mirror = read_map(file, with({true, 632.8, 0.5}));
  EXPECT_NEAR(mirror.at(0, 0), 316.4, 1e-9);
  EXPECT_NEAR(mirror.at(0, 1), -79.1, 1e-9);
  EXPECT_TRUE(std::isnan(mirror.at(0, 2)));
  EXPECT_NEAR(mirror.at(1, 2), 221.48, 1e-9);
  EXPECT_NEAR(read_map(file, with({true, 500.0, 1.0})).at(1, 1), 1500.0, 1e-9);
  ASSERT_EQ(mirror.history.size(), 1u);
  EXPECT_NE(mirror.history[0].find("waves of 632.8 nm"), std::string::npos) << mirror.history[0];
}

TEST(WaveScale, ValuesInWavesByTheirHeaderDoTheSame) {
  const TemporaryFolder folder;
  const auto file = folder.file("a.csv", std::string("# unit: waves\n") + kValues);
  EXPECT_NEAR(read_map(file, with({false, 632.8, 0.5})).at(0, 0), 316.4, 1e-9);
  EXPECT_NEAR(read_map(file, with({true, 632.8, 0.5})).at(0, 0), 316.4, 1e-9);
  const auto said = folder.file("b.csv", std::string("# unit: waves\n# wavelength: 633 nm\n") + kValues);
  EXPECT_NEAR(read_map(said, with({false, {}, 1.0})).at(0, 0), 633.0, 1e-9) << "the file says its wavelength";
  EXPECT_NEAR(read_map(said, with({false, 632.8, 1.0})).at(0, 0), 632.8, 1e-9) << "which is rounded there";
  expect_input_error(
      [&] {
        read_map(said, with({false, 543.5, 1.0}));
      },
      {"b.csv", "line 2, wavelength", "633 nm", "`wavelength` 543.5 nm", "agree"});
}

TEST(WaveScale, ThereIsNoDefaultForScaleOrWavelength) {
  const TemporaryFolder folder;
  const auto plain = folder.file("a.csv", kValues),
             said = folder.file("b.csv", std::string("# unit: waves\n") + kValues);
  expect_input_error(
      [&] {
        read_map(plain, with({true, {}, {}}));
      },
      {"a.csv", "`map unit` says waves", "required: `wavelength` [nm] and `wave scale`", "0.5 for a mirror"});
  expect_input_error(
      [&] {
        read_map(said, with({false, {}, {}}));
      },
      {"b.csv", "header says unit waves", "`wavelength` [nm] and `wave scale`"});
  expect_input_error([&] { read_map(said, with({false, 632.8, {}})); }, {"b.csv", "required: `wave scale`"});
  expect_input_error([&] { read_map(said, with({false, {}, 0.5})); }, {"b.csv", "required: `wavelength` [nm]"});
}

TEST(WaveScale, OptionsThatHaveNothingToSayAreRefused) {
  const TemporaryFolder folder;
  const auto plain = folder.file("a.csv", kValues), um = folder.file("b.csv", std::string("# unit: um\n") + kValues);
  const auto waves = folder.file("c.csv", std::string("# unit: waves\n") + kValues);
  expect_input_error(
      [&] {
        read_map(plain, with({false, 632.8, {}}));
      },
      {"a.csv", "`wavelength` is 632.8 nm", "not in waves", "`map unit` waves"});
  expect_input_error([&] { read_map(um, with({true, 632.8, 0.5})); }, {"b.csv", "unit um", "`map unit` says waves"});
  MapReadOptions in_nm = with({false, 632.8, 0.5});
  in_nm.scale = 1.0;
  expect_input_error([&] { read_map(waves, in_nm); }, {"c.csv", "unit waves", "`map unit` gives a factor of 1"});
  for (const double wrong : {0.0, -0.5, std::nan(""), HUGE_VAL}) {
    expect_input_error([&] { read_map(plain, with({true, 632.8, wrong})); }, {"`wave scale`", "> 0"});
    expect_input_error([&] { read_map(plain, with({true, wrong, 0.5})); }, {"`wavelength`", "> 0"});
  }
}

// An OPD in nm is a factor of two as well.
TEST(WaveScale, DataCalledAPathDifferenceNeedItsHeight) {
  const TemporaryFolder folder;
  const auto remark = folder.file("a.csv", std::string("# OPD, in um\n# unit: um\n") + kValues);
  const auto named = folder.file("m1_opd.csv", kValues);
  const auto points = folder.file("wavefront.xyz", "0 0 1\n0.5 0 2\n0 0.25 3\n0.5 0.25 5\n");
  expect_input_error([&] { read_map(remark, with({})); }, {"a.csv, line 1", "'OPD, in um'", "`wave scale`", "0.5 for"});
  expect_input_error([&] { read_map(named, with({})); }, {"m1_opd.csv", "the name of the file", "`wave scale`"});
  expect_input_error([&] { read_map(points, with({})); }, {"wavefront.xyz", "the name of the file"});
  EXPECT_NEAR(read_map(remark, with({false, {}, 0.5})).at(0, 0), 500.0, 1e-9);
  EXPECT_NEAR(read_map(named, with({false, {}, 0.5})).at(0, 1), -0.125, 1e-12);
  EXPECT_NEAR(read_map(points, with({false, {}, 0.25})).at(1, 1), 1.25, 1e-12);
  EXPECT_EQ(read_map(named, with({false, {}, 1.0})).at(0, 0), 1.0) << "heights in a file of a wrong name";
}

TEST(WaveScale, AMapThatWasWrittenIsOneOfHeights) {
  const TemporaryFolder folder;
  const auto file = folder.file("a_opd.csv", kValues);
  const HeightMap heights = read_map(file, with({true, 632.8, 0.5}));
  for (const char* name : {"b_opd.csv", "b_opd.npy", "b_opd.h5", "b_opd.fits", "b_opd.sdf", "b_opd.xyz"}) {
    write_map(folder.path() / name, heights);
    EXPECT_NEAR(read_map(folder.path() / name).at(1, 1), heights.at(1, 1), 1e-9) << name;
    MapReadOptions again;
    again.waves.scale = 0.5;
    expect_input_error([&] { read_map(folder.path() / name, again); }, {name, "`wave scale` is 0.5", "history"});
  }
}

TEST(WaveScale, OfADataSetCountsTheNameAndWhatIsSaidOfIt) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& path, const std::string& attribute, const std::string& text) {
    test::Hdf5TestFile made;
    made.doubles(path, {1, 3}, {1, 2, 4});
    made.text(path, "unit", "nm");
    if (!attribute.empty()) made.text(path, attribute, text);
    return folder.file("a.h5", made.bytes());
  };
  expect_input_error([&] { read_map(file("/run/opd", "", ""), with({})); },
                     {"a.h5", "data set '/run/opd'", "`wave scale`"});
  expect_input_error([&] { read_map(file("/wavefront/z", "", ""), with({})); }, {"data set '/wavefront/z'"});
  expect_input_error([&] { read_map(file("/z", "quantity", "transmitted wavefront"), with({})); },
                     {"attribute quantity"});
  EXPECT_EQ(read_map(file("/run/opd", "", ""), with({false, {}, 0.5})).at(0, 2), 2.0);
  EXPECT_EQ(read_map(file("/run/z", "quantity", "surface"), with({})).at(0, 2), 4.0);
}

TEST(WaveScale, AMeasurementOf4DIsReadAsBeforeUnlessAScaleIsGiven) {
  const TemporaryFolder folder;
  test::Hdf5TestFile made;
  made.doubles("/measurement0/genraw/data", {1, 2}, {0.5, -0.25});
  made.text("/measurement0/genraw", "wavelength", "600 nm", true);
  const auto file = folder.file("a.h5", made.bytes());
  EXPECT_NEAR(read_map(file, with({})).at(0, 0), 300.0, 1e-9);
  EXPECT_NEAR(read_map(file, with({false, {}, 0.5})).at(0, 1), -75.0, 1e-9);
  EXPECT_NEAR(read_map(file, with({true, 600.0, 0.5})).at(0, 1), -75.0, 1e-9);
  expect_input_error([&] { read_map(file, with({true, 632.8, 1.0})); }, {"a.h5", "600 nm", "`wavelength` 632.8 nm"});
}

TEST(WaveScale, RatesAreInNoWaves) {
  const TemporaryFolder folder;
  MapReadOptions rates = with({});
  rates.name = "tif";
  rates.quantity = MapQuantity::Rate;
  expect_input_error([&] { read_map(folder.file("a.csv", std::string("# unit: waves\n") + kValues), rates); },
                     {"tif", "'waves'", "nm/s"});
  expect_input_error([&] { read_map(folder.file("b.csv", std::string("# of an OPD\n") + kValues), rates); },
                     {"tif", "'of an OPD'", "rates (or heights) of the surface"});
}

}  // namespace
}  // namespace dwell
