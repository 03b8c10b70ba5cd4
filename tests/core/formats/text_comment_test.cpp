#include "core/formats/text_comment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

TEST(TextComment, IsBareWithoutQuotesAndPadding) {
  for (const char* line :
       {"# unit: um", "#unit: um,,", "\"# unit: um\",,", "  ## unit: um;;\t", "\"# unit: um\"", "# \"unit: um\""}) {
    EXPECT_TRUE(is_text_comment(line)) << line;
    EXPECT_EQ(bare_comment(line), "unit: um") << line;
  }
  EXPECT_EQ(bare_comment("#"), "");
  EXPECT_EQ(bare_comment("#,,"), "");
  for (const char* line : {"", "1,2", "#N/A,1", "\"#N/A\",1", "\"a\""}) EXPECT_FALSE(is_text_comment(line)) << line;
}

TEST(TextComment, OfASpreadsheetCounts) {
  const test::TemporaryFolder folder;
  // Spreadsheets quote a comment that holds a comma, and pad every line to the width of the table.
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char* line : {"\"# unit: um\",,", "# pitch_mm: 0.5,,", "1,2,4", "7,None,6"})
      text += std::string(line) + end;
    const HeightMap map = read_map(folder.file("a.csv", text));
    EXPECT_EQ(map.grid, (Grid{2, 3, 0.5, 0.5, {}})) << text;
    EXPECT_EQ(map.at(0, 2), 4e3);
    EXPECT_TRUE(std::isnan(map.at(1, 1)));
  }
  const HeightMap points = read_map(folder.file("a.xyz", "\"# x_mm y_mm z_um\",,\n0,0,1\n0.5,0,2\n0,1,3\n0.5,1,5\n"));
  EXPECT_EQ(points.grid, (Grid{2, 2, 0.5, 1.0, {}}));
  EXPECT_EQ(points.at(1, 1), 5e3);
}

}  // namespace
}  // namespace dwell
