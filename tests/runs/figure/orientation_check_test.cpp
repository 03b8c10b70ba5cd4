#include "runs/figure/orientation_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/map/map_turn.h"
#include "core/map/map_warp.h"

namespace dwell {
namespace {

/// What a run removes, without symmetry, as a function of the place [mm].
double removal_at(Point p) {
  return 40.0 * std::exp(-0.02 * ((p.x - 4.0) * (p.x - 4.0) + (p.y + 2.0) * (p.y + 2.0))) +
         25.0 * std::exp(-0.05 * ((p.x + 6.0) * (p.x + 6.0) + (p.y - 3.0) * (p.y - 3.0))) +
         6.0 * std::sin(0.4 * p.x + 0.9 * p.y);
}

const Grid kGrid{41, 51, 0.5, 0.6, {-12.5, -12.0}};   // rows, columns
const Grid kWide{81, 101, 0.5, 0.6, {-25.0, -24.0}};  // reaches beyond it

HeightMap map_on(const Grid& grid, const std::function<double(Point)>& height) {
  HeightMap map(grid);
  for (Index i = 0; i < grid.size(); ++i) map.values[static_cast<std::size_t>(i)] = height(grid.centre(i));
  return map;
}

HeightMap before_run() {
  return map_on(kGrid, [](Point p) { return 1.05 * removal_at(p) + 3.0 * std::cos(0.8 * p.x - 0.3 * p.y + 0.7); });
}

HeightMap after_removal(const std::function<double(Point)>& removal) {
  HeightMap after = before_run();
  for (Index i = 0; i < kGrid.size(); ++i) after.values[static_cast<std::size_t>(i)] -= removal(kGrid.centre(i));
  return after;
}

HeightMap removed_by(const HeightMap& before, const HeightMap& after) {
  HeightMap removed = before;
  for (std::size_t i = 0; i < removed.values.size(); ++i) removed.values[i] -= after.values[i];
  return removed;
}

OrientationCheck checked(const HeightMap& after) {
  const HeightMap before = before_run();
  return check_orientation(before, after, removed_by(before, after), map_on(kWide, removal_at), {true, true},
                           {4.0, 0.7}, 1);
}

TEST(OrientationCheck, FindsNoFaultWhereTheRateIsOffAndTheMapsTilted) {
  const OrientationCheck check = checked(after_removal([](Point p) { return 0.8 * removal_at(p) + 2.0 + 0.3 * p.x; }));
  EXPECT_EQ(check.fault, "");
  EXPECT_LT(check.as_thought, 1e-9);
  EXPECT_EQ(check.shift, Point{});
}

TEST(OrientationCheck, FindsAShiftThatIsTooLargeForAFitToStartFrom) {
  const OrientationCheck check = checked(after_removal([](Point p) { return removal_at(p - Point{2.5, -1.8}); }));
  EXPECT_EQ(check.fault, "");
  EXPECT_NEAR(check.shift.x, 2.5, 0.6);
  EXPECT_NEAR(check.shift.y, -1.8, 0.6);
}

/// Both ways in which a part can lie otherwise, for every turn and flip.
TEST(OrientationCheck, NamesEveryTurnAndFlipOfWhatWasRemoved) {
  const std::vector<std::pair<std::string, std::function<Point(Point)>>> lies{
      {"flipped left for right",
       [](Point p) {
         return Point{-p.x, p.y};
       }},
      {"flipped top for bottom",
       [](Point p) {
         return Point{p.x, -p.y};
       }},
      {"turned by 180",
       [](Point p) {
         return Point{-p.x, -p.y};
       }},
      {"turned by 90 degrees counter-clockwise",
       [](Point p) {
         return Point{p.y, -p.x};
       }},
      {"turned by 90 degrees clockwise",
       [](Point p) {
         return Point{-p.y, p.x};
       }},
      {"with x and y exchanged:",
       [](Point p) {
         return Point{p.y, p.x};
       }},
      {"with x and y exchanged and turned", [](Point p) {
         return Point{-p.y, -p.x};
       }}};
  for (const auto& [words, meant] : lies) {  // `meant`: where what was removed at p was meant to be
    const OrientationCheck check = checked(after_removal([&](Point p) { return removal_at(meant(p)); }));
    EXPECT_NE(check.fault.find("what was removed lies " + words), std::string::npos) << words << ": " << check.fault;
    EXPECT_LT(check.best, 0.2 * check.as_thought) << words;
  }
}

TEST(OrientationCheck, NamesAMapThatWasMeasuredTurned) {
  const HeightMap after = after_removal([](Point p) { return 0.9 * removal_at(p); });
  const OrientationCheck flipped = checked(turn_map(after, GridTurn::FlipX));
  EXPECT_NE(flipped.fault.find("the map after the run lies otherwise"), std::string::npos) << flipped.fault;
  EXPECT_NE(flipped.fault.find("--step 'flip:x'"), std::string::npos) << flipped.fault;
  const HeightMap quarter = warp_map(turn_map(after, GridTurn::Quarter), {}, kGrid);  // other pixels, the same place
  const OrientationCheck turned = checked(quarter);
  EXPECT_NE(turned.fault.find("--step 'rotate:270'"), std::string::npos) << turned.fault;
}

TEST(OrientationCheck, IsNotMisledByEdgesClampsAndDust) {
  const auto removal = [](Point p) { return 1.03 * removal_at(p); };
  HeightMap edges = after_removal(removal), clamp = edges, dust = edges;
  for (Index r = 0; r < kGrid.rows; ++r) {
    for (const Index c : {Index{0}, Index{1}, kGrid.cols - 2, kGrid.cols - 1}) edges.at(r, c) += 20.0;
  }
  for (Index r = 3; r < 9; ++r) {
    for (Index c = 40; c < 46; ++c) clamp.at(r, c) += 60.0;
  }
  for (Index k = 0; k < 25; ++k) dust.at((7 * k + 3) % kGrid.rows, (11 * k + 5) % kGrid.cols) += 50000.0;
  EXPECT_EQ(checked(edges).fault, "");
  EXPECT_EQ(checked(clamp).fault, "");
  EXPECT_EQ(checked(dust).fault, "");
}

TEST(OrientationCheck, KnowsATransposedMapWhoseOriginIsItsCorner) {
  // What an instrument gives that starts counting at the corner: the part is not square, and its middle lies elsewhere.
  HeightMap before = before_run(), after = after_removal([](Point p) { return 0.9 * removal_at(p); });
  HeightMap predicted = map_on(kWide, removal_at);
  const Point corner = kGrid.origin;
  for (HeightMap* map : {&before, &after, &predicted}) map->grid.origin = map->grid.origin - corner;
  HeightMap turned = turn_map(after, GridTurn::Transpose);
  turned.grid.origin = {0.0, 0.0};
  const HeightMap on_part = warp_map(turned, {}, before.grid);
  const OrientationCheck check =
      check_orientation(before, turned, removed_by(before, on_part), predicted, {true, true}, {4.0, 0.7}, 1);
  EXPECT_NE(check.fault.find("with x and y exchanged"), std::string::npos) << check.fault;
  EXPECT_NE(check.fault.find("--step 'transpose; fiducials:shift"), std::string::npos) << check.fault;
}

TEST(OrientationCheck, SeesWhereASingleBumpWasRemoved) {
  // Most of the part is left alone: the median of what was removed says nothing of the bump.
  const auto bump = [](Point p) {  // of no symmetry of its own
    const double x = p.x - 6.0, y = p.y + 4.0, u = x - 3.0, v = y - 2.0;
    return 80.0 * std::exp(-0.1 * x * x - 0.5 * y * y) + 40.0 * std::exp(-0.4 * (u * u + v * v));
  };
  const auto noise = [](Point p) { return 0.1 * std::sin(37.0 * p.x + 91.0 * p.y * p.y); };
  const HeightMap before = map_on(kGrid, [&](Point p) { return bump(p) + noise(p); });
  const auto check = [&](const std::function<double(Point)>& removal) {
    HeightMap after = before;
    for (Index i = 0; i < kGrid.size(); ++i) after.values[static_cast<std::size_t>(i)] -= removal(kGrid.centre(i));
    return check_orientation(before, after, removed_by(before, after), map_on(kWide, bump), {true, true}, {4.0, 0.7},
                             1);
  };
  EXPECT_EQ(check([&](Point p) { return 0.9 * bump(p) + noise(p); }).fault, "");
  const std::string fault = check([&](Point p) { return bump({-p.x, p.y}) + noise(p); }).fault;
  EXPECT_NE(fault.find("flipped left for right"), std::string::npos) << fault;
}

TEST(OrientationCheck, SaysNothingOfARemovalThatIsAlikeUnderAFlip) {
  const auto even = [](Point p) { return 30.0 * std::cos(0.2 * p.x) * std::cos(0.25 * p.y); };
  const HeightMap before = map_on(kGrid, [&](Point p) { return 1.1 * even(p) + 2.0 * std::sin(p.x + 0.4 * p.y); });
  HeightMap after = before;
  for (Index i = 0; i < kGrid.size(); ++i) after.values[static_cast<std::size_t>(i)] -= even(kGrid.centre(i));
  EXPECT_EQ(
      check_orientation(before, after, removed_by(before, after), map_on(kWide, even), {true, true}, {4.0, 0.7}, 1)
          .fault,
      "");
}

}  // namespace
}  // namespace dwell
