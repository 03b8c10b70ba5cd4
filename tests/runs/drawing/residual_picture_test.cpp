#include "runs/drawing/residual_picture.h"

#include <gtest/gtest.h>

#include "core/base/random_numbers.h"

namespace dwell {
namespace {

/// Noise of 1 nm with two pits that stand close together, and one far from them.
HeightMap pitted() {
  RandomNumbers random(31);
  HeightMap map(Grid{80, 110, 0.25, 0.2, {-5.0, 1.0}});
  for (double& v : map.values) v = random.normal();
  map.at(40, 30) -= 900.0, map.at(42, 30) -= 200.0, map.at(60, 90) -= 100.0;
  return map;
}

bool has(const std::string& svg, const std::string& words) { return svg.find(">" + words + "<") != std::string::npos; }

TEST(ResidualPicture, RingsBlemishesAndSaysWhereItsColoursEnd) {
  const HeightMap map = pitted();
  const ResidualAnatomy anatomy = residual_anatomy(map, 3.0, {});
  ASSERT_EQ(anatomy.blemishes.size(), 3u);
  const std::string svg = residual_picture(map, anatomy, "A title", FigureFormat::Svg);
  EXPECT_TRUE(has(svg, "A title"));
  EXPECT_NE(svg.find("robust"), std::string::npos);
  EXPECT_NE(svg.find("rings"), std::string::npos);
  EXPECT_TRUE(has(svg, "1, 2")) << "two in one ring";
  EXPECT_TRUE(has(svg, "3"));
  EXPECT_NE(svg.find("min -9"), std::string::npos) << "the extreme pixel is said, and does not set the scale";
}

TEST(ResidualPicture, HasNoRingsWithoutBlemishes) {
  const HeightMap map = pitted();
  const ResidualAnatomy anatomy = residual_anatomy(map, 3.0, {}, 1, BlemishSearch::Off);
  const std::string svg = residual_picture(map, anatomy, "A title", FigureFormat::Svg);
  EXPECT_EQ(svg.find("rings"), std::string::npos);
  EXPECT_FALSE(has(svg, "1, 2"));
  EXPECT_NE(svg.find("1.5"), std::string::npos);
}

TEST(ResidualPicture, OfASurfaceThatIsZeroIsDrawn) {
  HeightMap map(Grid{30, 40, 0.5, 0.5, {}});
  for (double& v : map.values) v = 0.0;
  EXPECT_FALSE(residual_picture(map, residual_anatomy(map, 3.0, {}), "zero").empty());
}

}  // namespace
}  // namespace dwell
