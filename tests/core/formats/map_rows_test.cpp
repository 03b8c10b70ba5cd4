#include "core/formats/map_rows.h"

#include <gtest/gtest.h>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

TEST(MapRows, TurnTheRowsOverWhereTheFirstIsTheTop) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("a.csv", "# pitch_mm: 0.5\n# row 0 = top\n1,2\n3,4\n5,7\n");
  MapReadOptions options;
  test::expect_input_error([&] { read_map(file, options); },
                           {"a.csv, line 2", "'row 0 = top'", "orientation", "`map rows`"});
  options.rows = MapRows::Bottom;
  EXPECT_EQ(read_map(file, options).values, (std::vector<double>{1, 2, 3, 4, 5, 7}));
  EXPECT_TRUE(read_map(file, options).history.empty());
  options.rows = MapRows::Top;
  const HeightMap map = read_map(file, options);
  EXPECT_EQ(map.values, (std::vector<double>{5, 7, 3, 4, 1, 2}));
  EXPECT_EQ(map.history, std::vector<std::string>{"rows: the first row of the file taken for the largest y"});
  const auto points = folder.file("a.xyz", "0 0 1\n1 0 2\n0 1 3\n1 1 5\n");
  test::expect_input_error([&] { read_map(points, options); }, {"a.xyz", "`map rows`", "points"});
}

TEST(MapRows, AreSpelledOneWay) {
  for (const char* text : {"bottom", "top"}) EXPECT_EQ(to_string(parse_map_rows(text)), text);
  test::expect_input_error([] { parse_map_rows("up"); }, {"'up'", "bottom", "top"});
}

}  // namespace
}  // namespace dwell
