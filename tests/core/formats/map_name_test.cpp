#include "core/formats/map_name.h"

#include <gtest/gtest.h>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

TEST(MapName, SplitsAtTheFirstColonBeforeASlash) {
  struct Case {
    std::string text, file, inside;
  };
  for (const Case& c : {Case{"run.h5:/a/b", "run.h5", "/a/b"}, Case{"run.h5", "run.h5", ""},
                        Case{"x/run.h5:/a:/b", "x/run.h5", "/a:/b"}, Case{"a:b.csv", "a:b.csv", ""},
                        Case{":/a", ":/a", ""}, Case{"run.h5:/", "run.h5", "/"}}) {
    const MapName name = split_map_name(c.text);
    EXPECT_EQ(name.file.string(), c.file) << c.text;
    EXPECT_EQ(name.inside, c.inside) << c.text;
  }
}

TEST(MapName, IsTheFileOfTheWholeNameIfThereIsOne) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "odd:");
  folder.file("odd:/a.csv", "# pitch_mm: 1\n1,2\n");
  EXPECT_EQ(split_map_name(folder.path() / "odd:/a.csv").inside, "");
  EXPECT_EQ(read_map(folder.path() / "odd:/a.csv").at(0, 1), 2.0);
}

TEST(MapName, IsSplitBehindTheNameOfAFile) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("a:b.fits", "x").string();
  EXPECT_EQ(split_map_name(file + ":OPD").file.string(), file);
  EXPECT_EQ(split_map_name(file + ":OPD").inside, "OPD");
  EXPECT_EQ(split_map_name(file + ":2").inside, "2");
  EXPECT_EQ(split_map_name(file).inside, "");
  EXPECT_EQ(split_map_name(file + "x:2").inside, "") << "no such file";
}

TEST(MapName, FormatsOfOneArrayRefuseAPath) {
  const test::TemporaryFolder folder;
  const std::string text = folder.file("a.csv", "# pitch_mm: 1\n1,2\n").string();
  test::expect_input_error([&] { read_map(text + ":/b"); }, {"a.csv:/b", "text", "leave out ':/b'"});
  test::expect_input_error([&] { read_map(text + ":2"); }, {"a.csv:2", "leave out ':2'"});
  HeightMap map(Grid{1, 2, 1.0, 1.0, {}}, {1.0, 2.0});
  write_map(folder.path() / "a.npy", map);
  test::expect_input_error([&] { read_map((folder.path() / "a.npy").string() + ":/b"); },
                           {"a.npy:/b", "NPY", "leave out ':/b'"});
}

}  // namespace
}  // namespace dwell
