#include "core/formats/unpacked_size.h"

#include <gtest/gtest.h>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

TEST(UnpackedSize, MustBeModerateOrASmallMultipleOfTheFile) {
  constexpr double kSide = 16384.0;
  EXPECT_NO_THROW(check_unpacked(4096, 8192, 1e3, {}, "map a")) << "256 MiB of a small file";
  EXPECT_NO_THROW(check_unpacked(kSide, kSide, kSide * kSide * 8.0 / 100.0, {}, "map a"));
  test::expect_input_error([&] { check_unpacked(4096, 8193, 1e3, {}, "map a"); },
                           {"map a: 4096 x 8193", "268 MB", "100 times", "`max pixels` 33558528"});
  EXPECT_NO_THROW(check_unpacked(4096, 8193, 1e3, {33558528.0}, "map a"));
  test::expect_input_error([&] { check_unpacked(4096, 8193, 1e12, {33558527.0}, "map a"); }, {"33558527 pixels"});
  test::expect_input_error([&] { check_unpacked(kSide, kSide + 1, 1e12, {}, "map a"); }, {"268435456 pixels"});
}

TEST(UnpackedSize, RefusesAnHdf5FileMadeToFillTheMemory) {
  const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
  constexpr hsize_t kSide = 6144;
  const hsize_t chunk[2] = {kSide / 8, kSide};
  H5Pset_chunk(packed, 2, chunk);
  H5Pset_deflate(packed, 1);
  test::Hdf5TestFile file;
  file.data_set("/m", {kSide, kSide}, std::vector<signed char>(kSide * kSide, 0), H5T_NATIVE_SCHAR, H5T_STD_I8LE,
                packed);
  H5Pclose(packed);
  const std::string bytes = file.bytes();
  ASSERT_LT(bytes.size(), 1000000u);
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.h5", bytes);
  MapReadOptions options;
  options.pitch = square_pitch(0.01);
  test::expect_input_error([&] { read_map(path, options); }, {"a.h5", "'/m'", "6144 x 6144", "`max pixels` 37748736"});
  options.limit = {37748736.0};
  EXPECT_EQ(read_map(path, options).grid.rows, 6144);
}

TEST(PixelLimit, IsThatOfEveryReader) {
  const test::TemporaryFolder folder;
  const HeightMap map(Grid{2, 3, 0.5, 0.25, {}}, {1, 2, 3, 4, 5, 6});
  MapReadOptions options;
  const auto refused = [&](const std::filesystem::path& file) {
    options.limit = {5.0};
    test::expect_input_error([&] { read_map(file, options); },
                             {file.filename().string(), "2 x 3 pixels", "from 1 to 5 pixels", "`max pixels`"});
    options.limit = {6.0};
    EXPECT_EQ(read_map(file, options).at(1, 2), 6.0) << file;
  };
  for (const char* name : {"a.csv", "a.txt", "a.xyz", "a.npy", "a.h5", "a.fits", "a.sdf"}) {
    write_map(folder.path() / name, map);
    refused(folder.path() / name);
  }
  options.pitch = square_pitch(0.5);
  refused(folder.file("a.int", "title\nGRD 3 2 SUR WVL 1 SSZ 1000\n4 5 6 1 2 3\n").parent_path() / "a.int");
}

}  // namespace
}  // namespace dwell
