#include "runs/job/path_list.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

std::vector<std::string> texts(const std::string& list, double pitch = 1.5) {
  std::vector<std::string> out;
  for (const ListedPath& p : parse_path_list(list, pitch)) out.push_back(p.text);
  return out;
}

using Texts = std::vector<std::string>;

TEST(PathList, GivesThePitchToThosePathsThatSayNone) {
  EXPECT_EQ(texts("raster,nearest"), (Texts{"raster:pitch=1.5", "nearest:cell=1.5"}));
  EXPECT_EQ(texts("raster:pitch=2,angle=30,raster:angle=45,nearest:cell=1,critical=-inf"),
            (Texts{"raster:pitch=2,angle=30", "raster:angle=45,pitch=1.5", "nearest:cell=1,critical=-inf"}));
  EXPECT_EQ(texts("raster:"), (Texts{"raster:pitch=1.5"}));
  EXPECT_EQ(texts(" raster , nearest:cell=3 "), (Texts{"raster:pitch=1.5", "nearest:cell=3"}));
}

TEST(PathList, CutsAtSemicolonsAloneWhereThereAreAny) {
  EXPECT_EQ(texts("file:a,b.csv;raster:pitch=2,step=1"), (Texts{"file:a,b.csv", "raster:pitch=2,step=1"}));
  EXPECT_EQ(texts("file:a.csv,raster"), (Texts{"file:a.csv", "raster:pitch=1.5"}));
}

TEST(PathList, NumbersKindsThatComeAgain) {
  const std::vector<ListedPath> paths = parse_path_list("raster,nearest,raster:angle=9,raster:angle=5", 1.0);
  ASSERT_EQ(paths.size(), 4u);
  EXPECT_EQ(paths[0].name, "raster");
  EXPECT_EQ(paths[1].name, "nearest");
  EXPECT_EQ(paths[2].name, "raster-2");
  EXPECT_EQ(paths[3].name, "raster-3");
}

TEST(PathList, RefusesWhatIsNone) {
  for (const char* list : {"", "raster,,nearest", "raster,", "raster;;nearest", ","}) {
    expect_input_error([&] { parse_path_list(list, 1.0); }, {"--paths", "empty entry", "'" + std::string(list) + "'"});
  }
  expect_input_error([] { parse_path_list("raster,zigzag", 1.0); }, {"unknown kind \"zigzag\"", "accepted", "raster"});
  expect_input_error([] { parse_path_list("raster:ptich=2", 1.0); }, {"unknown key \"ptich\""});
  expect_input_error([] { parse_path_list("pitch=2,raster", 1.0); }, {"pitch=2"});
}

}  // namespace
}  // namespace dwell
