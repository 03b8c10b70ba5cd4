#include "core/formats/part_size.h"

#include <gtest/gtest.h>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

TEST(PartSize, AcceptsPartsFromAPixelOfAnAtomToTheLargestMirror) {
  EXPECT_NO_THROW(check_part_size({3, 4, 1e-7, 1e-7, {}}, "pitch", "map a"));
  EXPECT_NO_THROW(check_part_size({100, 200, 100.0, 200.0, {1e9, 0.0}}, "pitch", "map a"));
  const auto refused = [](const Grid& grid) {
    test::expect_input_error([&] { check_part_size(grid, "Xscale = 1 [m]", "map a"); },
                             {"map a: Xscale = 1 [m]", "at least 1e-07 mm", "at most 20000 mm", "unit"});
  };
  refused({3, 4, 0.9e-7, 1.0, {}});
  refused({3, 4, 1.0, 0.9e-7, {}});
  refused({201, 4, 1.0, 100.0, {}});
  refused({4, 201, 100.0, 1.0, {}});
}

TEST(PartSize, IsAskedOfEveryReader) {
  const test::TemporaryFolder folder;
  MapReadOptions options;
  options.pitch = square_pitch(2e4);
  const auto plain = folder.file("a.csv", "1,2\n3,4\n");
  test::expect_input_error([&] { read_map(plain, options); }, {"a.csv", "`map pixel`", "40000 x 40000 mm"});
  const auto header = folder.file("b.csv", "# pitch_mm: 1e-8\n1,2\n3,4\n");
  test::expect_input_error([&] { read_map(header); }, {"b.csv", "pitch_mm", "1e-08"});
  const auto points = folder.file("c.xyz", "x y z\n0 0 1\n50000 0 2\n0 50000 3\n");
  test::expect_input_error([&] { read_map(points); }, {"c.xyz", "points' pitch", "100000"});
  HeightMap map(Grid{2, 2, 20e3, 20e3, {}}, {1, 2, 3, 4});
  for (const char* name : {"d.npy", "d.h5", "d.fits"}) {
    write_map(folder.path() / name, map);
    test::expect_input_error([&] { read_map(folder.path() / name); }, {name, "40000 x 40000 mm", "at most 20000"});
  }
  write_map(folder.path() / "d.sdf", map);  // its own reader is stricter
  test::expect_input_error([&] { read_map(folder.path() / "d.sdf"); }, {"Xscale = 20, Yscale = 20 [m]"});
  test::expect_input_error([&] { read_map(folder.path() / "d.npy"); }, {"d.npy.json", "pitch_mm = 20000"});
}

}  // namespace
}  // namespace dwell
