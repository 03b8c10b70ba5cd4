// The headers that are installed need only such as are installed, and the checker that says so finds what is missing.

#include "tests/architecture/public_face.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/architecture/house_rules.h"

namespace dwell::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> texts(const std::vector<Violation>& violations) {
  std::vector<std::string> found;
  for (const Violation& violation : violations) found.push_back(violation.to_string());
  return found;
}

std::vector<SourceFile> small_house() {
  return {{"core/map/height_map.h", "#include \"core/base/grid.h\"\n#include <vector>\n"},
          {"core/map/height_map.cpp", "#include \"core/numerics/fft.h\"\n"},
          {"core/base/grid.h", ""},
          {"core/base/deep/hidden.h", ""}};
}

TEST(PublicFace, OfTheTreeIsClosed) {
  std::ifstream stream(DWELL_SOURCE_DIR "/cmake/public_headers.txt");
  const std::string list{std::istreambuf_iterator<char>(stream), {}};
  const std::vector<SourceFile> files = read_house(DWELL_SOURCE_DIR);
  EXPECT_THAT(public_headers(list, files), ::testing::Contains("core/map/height_map.h"));
  EXPECT_THAT(texts(check_public_face(list, files)), IsEmpty());
}

TEST(PublicFace, NamesHeadersOneByOneAndByFolder) {
  EXPECT_THAT(public_headers("# why\n\ncore/base/*\ncore/map/height_map.h\n", small_house()),
              ElementsAre("core/base/grid.h", "core/map/height_map.h"));
}

TEST(PublicFace, MayNotNeedWhatIsNotPublic) {
  EXPECT_THAT(texts(check_public_face("core/map/height_map.h\ncore/base/*\n", small_house())), IsEmpty());
  EXPECT_THAT(texts(check_public_face("core/map/height_map.h\n", small_house())),
              ElementsAre(HasSubstr("core/map/height_map.h:1: a public header includes \"core/base/grid.h\"")));
}

TEST(PublicFace, MayNotNameWhatIsNotThere) {
  EXPECT_THAT(texts(check_public_face("core/base/*\ncore/bass/*\ncore/map/height_map.cpp\n", small_house())),
              ElementsAre(HasSubstr("public_headers.txt:2: no header"), HasSubstr("public_headers.txt:3: no header")));
}

}  // namespace
}  // namespace dwell::architecture
