#include "paths/lines/multi_pitch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "paths/path_catalogue.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::brute_force_distance;
using test::full_map;
using test::kInf;
using test::kNaN;

RemovalFunction tool() { return gaussian_removal(10.0, 2.0, 3.0); }  // size 6 mm

MultiPitchOptions given(std::vector<double> pitches, double step) {
  MultiPitchOptions o;
  o.pitches = std::move(pitches);
  o.step = step;
  o.smooth = 0.0;
  return o;
}

TEST(MultiPitch, PitchesAreEquations9And10) {
  const std::vector<PitchRegion> ranges = pitches_by_depth({0.0, 100.0, 200.0, 300.0, 400.0}, 2000.0, 50.0, 0.01, 10.0);
  const std::vector<double> depths{50.0, 100.0, 200.0, 300.0};
  ASSERT_EQ(ranges.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(ranges[k].depth, depths[k]);
    EXPECT_DOUBLE_EQ(ranges[k].pitch, 2000.0 / (depths[k] * 50.0));
    EXPECT_EQ(ranges[k].limit, PitchRegion::Limit::None);
    EXPECT_EQ(ranges[k].from, 100.0 * static_cast<double>(k));
    EXPECT_EQ(ranges[k].to, 100.0 * static_cast<double>(k + 1));
  }
}

TEST(MultiPitch, PitchesStayWithinTheirLimits) {
  const auto ranges = pitches_by_depth({0.0, 100.0, 200.0, 300.0, 400.0}, 2000.0, 50.0, 0.15, 0.5);
  EXPECT_EQ(ranges[0].pitch, 0.5);
  EXPECT_EQ(ranges[0].limit, PitchRegion::Limit::Widest);
  EXPECT_DOUBLE_EQ(ranges[1].pitch, 0.4);
  EXPECT_EQ(ranges[3].pitch, 0.15);
  EXPECT_EQ(ranges[3].limit, PitchRegion::Limit::Narrowest);
  const auto flat = pitches_by_depth({0.0, 0.0}, 2000.0, 50.0, 0.15, 0.5);
  EXPECT_EQ(flat[0].pitch, 0.5) << "nothing to remove";
}

/// Heights in steps along x, so that the regions are known.
HeightMap stairs() {
  HeightMap map = full_map(21, 41, 0.5, 0.4, {3.0, -2.0});
  for (Index i = 0; i < map.grid.size(); ++i) {
    map.values[static_cast<std::size_t>(i)] = -7.0 + 10.0 * static_cast<double>((i % 41) / 10);  // -7, 3, 13, 23, 33
  }
  return map;
}

TEST(MultiPitch, RegionsHaveTheirPitchesAndNoOverlap) {
  MultiPitchOptions o = given({1.2, 0.8, 0.6, 0.5}, 0.3);
  o.overrun = 0.0;
  const MultiPitchPath result = multi_pitch_path(stairs(), tool(), kInf, o);
  EXPECT_EQ(result.path.kind, "multi-pitch");
  EXPECT_EQ(result.lowest, -7.0);
  ASSERT_EQ(result.regions.size(), 4u);
  const std::vector<double> left{2.75, 7.75, 12.75, 17.75}, right{7.75, 12.75, 17.75, 23.25};
  std::size_t first = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const PitchRegion& r = result.regions[k];
    EXPECT_EQ(r.first_point, first);
    EXPECT_EQ(r.limit, PitchRegion::Limit::Given);
    EXPECT_EQ(r.pixels, k < 3 ? 210u : 231u) << "the highest depth belongs to the last range";
    EXPECT_EQ(result.path.lifted[first], 1);
    EXPECT_EQ(r.lifts, 0);
    std::vector<double> lines;
    for (std::size_t j = first; j < first + r.points; ++j) {
      const double beyond = k == 0 || k == 3 ? 0.7 : 1e-9;  // the part's edge: half a diagonal of pitch and step
      EXPECT_GE(result.path.points[j].x, left[k] - beyond);
      EXPECT_LE(result.path.points[j].x, right[k] + beyond);
      lines.push_back(result.path.points[j].y);
    }
    std::sort(lines.begin(), lines.end());
    for (std::size_t j = 1; j < lines.size(); ++j) {
      const double apart = lines[j] - lines[j - 1];
      EXPECT_TRUE(apart < 1e-9 || std::abs(apart - r.pitch) < 1e-9) << apart;
    }
    first += r.points;
  }
  EXPECT_EQ(first, result.path.size());
  const std::vector<double> pitch = result.pitch_of_points();
  EXPECT_EQ(pitch.front(), 1.2);
  EXPECT_EQ(pitch.back(), 0.5);
  ASSERT_EQ(result.path.notes.size(), 1u);
  EXPECT_EQ(
      result.path.notes[0],
      "4 ranges of removal depth above -7 nm, in 4 regions of 0.3 mm between dwell points: 0 to 10 nm, pitch 1.2 mm "
      "(given); 10 to 20 nm, pitch 0.8 mm (given); 20 to 30 nm, pitch 0.6 mm (given); 30 to 40 nm, pitch 0.5 mm "
      "(given)");
}

TEST(MultiPitch, RangesOfOnePitchAreOneRegionAndEmptyOnesAreLeftOut) {
  MultiPitchOptions o = given({0.8, 0.8, 0.5, 0.4, 0.3}, 0.3);
  o.depths = {5.0, 15.0, 17.0, 25.0};
  const MultiPitchPath result = multi_pitch_path(stairs(), tool(), kInf, o);
  ASSERT_EQ(result.regions.size(), 3u);  // 0-15 at 0.8; 15-17 holds nothing; 17-25 at 0.4; 25-40 at 0.3
  EXPECT_EQ(result.regions[0].from, 0.0);
  EXPECT_EQ(result.regions[0].to, 15.0);
  EXPECT_EQ(result.regions[0].pixels, 420u);
  EXPECT_EQ(result.regions[1].pitch, 0.4);
  EXPECT_EQ(result.regions[2].pitch, 0.3);
}

TEST(MultiPitch, TakesItsDefaultsFromTheToolAndTheFeed) {
  // 40 nm in four ranges; d_k = volume / (r_k v), at most a sixth of the size, 1 mm.
  const RemovalFunction tif = tool();
  MultiPitchOptions o;
  o.smooth = 0.0;
  const double feed = tif.volume / (10.0 * 0.9);  // d_2 = 0.9 mm
  const MultiPitchPath result = multi_pitch_path(stairs(), tif, feed, o);
  ASSERT_EQ(result.regions.size(), 4u);
  EXPECT_DOUBLE_EQ(result.regions[0].pitch, 1.0);
  EXPECT_EQ(result.regions[0].limit, PitchRegion::Limit::Widest);
  EXPECT_DOUBLE_EQ(result.regions[1].pitch, 0.9);
  EXPECT_DOUBLE_EQ(result.regions[3].pitch, 0.3);
  EXPECT_DOUBLE_EQ(result.step, 0.5);
  EXPECT_NE(result.path.notes[0].find("0 to 10 nm, pitch 1 mm (widest accepted)"), std::string::npos);
  const MultiPitchPath fast = multi_pitch_path(stairs(), tif, 1e3 * feed, o);
  ASSERT_EQ(fast.regions.size(), 1u);
  EXPECT_DOUBLE_EQ(fast.regions[0].pitch, 0.1) << "a sixtieth of the size";
  EXPECT_EQ(fast.regions[0].limit, PitchRegion::Limit::Narrowest);
  double low = kInf;
  for (const Point p : result.path.points) low = std::min(low, p.y);
  EXPECT_LT(low, -2.0 - 2.0) << "overrun: the tool's radius";
  EXPECT_GE(low, -2.0 - 3.0 - 1e-9);
}

TEST(MultiPitch, SmoothingKeepsNoiseFromTearingRegions) {
  HeightMap map = stairs();
  map.values[5] = -400.0;  // one bad pixel
  MultiPitchOptions o = given({0.8, 0.4}, 0.3);
  EXPECT_EQ(multi_pitch_path(map, tool(), kInf, o).lowest, -400.0);
  o.smooth = 4.0;
  EXPECT_GT(multi_pitch_path(map, tool(), kInf, o).lowest, -60.0);
}

TEST(MultiPitch, AFlatTargetIsOnePlainRaster) {
  const MultiPitchPath result = multi_pitch_path(full_map(10, 14), tool(), 50.0, {});
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_EQ(result.regions[0].pitch, 1.0);
  EXPECT_EQ(result.regions[0].lifts, 0);
}

// --- properties on random parts ---------------------------------------------------------------------------------

struct Part {
  HeightMap map;
  MultiPitchOptions options;
};

/// A blob of random holes and pieces with unequal pixel pitches; heights smooth enough for regions of some size.
Part random_part(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const Index rows = seed % 7 == 1 ? 1 : 8 + static_cast<Index>(random() % 25);
  const Index cols = seed % 7 == 2 ? 1 : 8 + static_cast<Index>(random() % 25);
  HeightMap map(Grid{rows, cols, uniform(0.2, 0.9), uniform(0.2, 0.9), {uniform(-30, 30), uniform(-30, 30)}});
  const double kx = uniform(0.1, 0.9), ky = uniform(0.1, 0.9), phase = uniform(0.0, 6.0);
  for (Index i = 0; i < map.grid.size(); ++i) {
    const auto r = static_cast<double>(i / cols), c = static_cast<double>(i % cols);
    map.values[static_cast<std::size_t>(i)] = 100.0 * std::sin(kx * c + phase) * std::cos(ky * r) + uniform(0.0, 5.0);
  }
  for (int hole = 0; hole < 4; ++hole) {
    const Point at{uniform(0.0, static_cast<double>(cols)), uniform(0.0, static_cast<double>(rows))};
    const double radius = uniform(0.0, 6.0);
    for (Index i = 0; i < map.grid.size(); ++i) {
      const Point p{static_cast<double>(i % cols), static_cast<double>(i / cols)};
      if (distance(p, at) < radius) map.values[static_cast<std::size_t>(i)] = kNaN;
    }
  }
  if (seed % 7 == 3) std::fill(map.values.begin(), map.values.end(), kNaN);
  if (map.valid_pixels() == 0) map.values[map.values.size() / 2] = 3.0;
  MultiPitchOptions o = given({uniform(0.5, 1.5), uniform(0.3, 1.0), uniform(0.15, 0.6)}, uniform(0.15, 0.7));
  o.angle_deg = seed % 3 == 0 ? 0.0 : uniform(-200.0, 200.0);
  o.overrun = seed % 4 == 0 ? 0.0 : uniform(0.0, 2.0);
  o.smooth = seed % 2 == 0 ? 0.0 : 1.0;
  o.lift = uniform(1.0, 6.0);
  return {map, o};
}

class MultiPitchProperties : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(MultiPitchProperties, HoldOnRandomParts) {
  const Part part = random_part(GetParam());
  const Grid& g = part.map.grid;
  const MultiPitchPath result = multi_pitch_path(part.map, tool(), kInf, part.options);
  const std::vector<Point>& points = result.path.points;
  ASSERT_EQ(points.size(), result.path.lifted.size());
  ASSERT_FALSE(points.empty());
  const std::vector<double> pitch = result.pitch_of_points();
  const double a = part.options.angle_deg * std::numbers::pi / 180.0, step = *part.options.step;
  const Point along{std::cos(a), std::sin(a)}, across{-along.y, along.x};
  std::size_t pixels = 0;
  for (const PitchRegion& region : result.regions) {
    pixels += region.pixels;
    Index lifts = -1;
    const Point origin = points[region.first_point];
    std::vector<std::pair<long, long>> places;
    for (std::size_t j = region.first_point; j < region.first_point + region.points; ++j) {
      const Point p = points[j];
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
      const double reach = std::max(
          {*part.options.overrun, 0.5 * std::hypot(region.pitch, step), 0.5 * std::hypot(g.pitch_x, g.pitch_y)});
      ASSERT_LE(brute_force_distance(part.map, p), reach + 1e-6);
      const double line = ((p - origin).x * across.x + (p - origin).y * across.y) / region.pitch;
      const double place = ((p - origin).x * along.x + (p - origin).y * along.y) / step;
      ASSERT_NEAR(line, std::round(line), 1e-6);
      ASSERT_NEAR(place, std::round(place), 1e-6);
      places.emplace_back(std::lround(line), std::lround(place));
      lifts += result.path.lifted[j];
      if (j > region.first_point && !result.path.lifted[j]) {
        ASSERT_LE(distance(p, points[j - 1]), part.options.lift * std::max(region.pitch, step) + 1e-9);
      }
    }
    EXPECT_EQ(lifts, region.lifts);
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "a lattice point twice";
  }
  EXPECT_EQ(static_cast<Index>(pixels), part.map.valid_pixels());
}

/// Every pixel centre within max(pitch, step) of a point of a region of its own pitch. The region of a pixel is worked
/// out here from depths alone.
TEST_P(MultiPitchProperties, CoverEveryPixel) {
  Part part = random_part(GetParam());
  part.options.smooth = 0.0;
  const MultiPitchPath result = multi_pitch_path(part.map, tool(), kInf, part.options);
  double low = kInf, high = -kInf;
  for (const double z : part.map.values) {
    if (std::isfinite(z)) low = std::min(low, z), high = std::max(high, z);
  }
  for (const Index i : finite_pixels(part.map)) {
    const double depth = part.map.values[static_cast<std::size_t>(i)] - low;
    const auto range = std::min(2.0, std::floor(high > low ? depth / (high - low) * 3.0 * (1.0 + 1e-14) : 0.0));
    const double wanted = part.options.pitches[static_cast<std::size_t>(high > low ? range : 2.0)];
    double nearest = kInf;
    for (const PitchRegion& region : result.regions) {
      if (region.pitch != wanted) continue;
      for (std::size_t j = region.first_point; j < region.first_point + region.points; ++j) {
        nearest = std::min(nearest, distance(result.path.points[j], part.map.grid.centre(i)));
      }
    }
    EXPECT_LE(nearest, std::max(wanted, *part.options.step) + 1e-9) << "pixel " << i;
  }
}

TEST_P(MultiPitchProperties, AreTheSameBytesAgain) {
  const Part part = random_part(GetParam());
  const MultiPitchPath one = multi_pitch_path(part.map, tool(), kInf, part.options);
  const MultiPitchPath two = multi_pitch_path(part.map, tool(), kInf, part.options);
  ASSERT_EQ(one.path.points.size(), two.path.points.size());
  EXPECT_EQ(std::memcmp(one.path.points.data(), two.path.points.data(), one.path.points.size() * sizeof(Point)), 0);
  EXPECT_EQ(one.path.lifted, two.path.lifted);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MultiPitchProperties, ::testing::Range<std::uint64_t>(1, 43));

// --- options ----------------------------------------------------------------------------------------------------

MultiPitchOptions parsed(const std::string& text) { return options_of<MultiPitchOptions>(parse_path_spec(text)); }

TEST(MultiPitch, ParsesItsOptions) {
  const MultiPitchOptions full =
      parsed("multi-pitch:pitches=0.8/0.4/0.2,depths=50/200,step=0.3,angle=90,overrun=2,lift=inf,smooth=0");
  EXPECT_EQ(full.pitches, (std::vector<double>{0.8, 0.4, 0.2}));
  EXPECT_EQ(full.depths, (std::vector<double>{50.0, 200.0}));
  EXPECT_EQ(full.step, 0.3);
  EXPECT_EQ(full.angle_deg, 90.0);
  EXPECT_EQ(full.overrun, 2.0);
  EXPECT_EQ(full.lift, kInf);
  EXPECT_EQ(full.smooth, 0.0);
  const MultiPitchOptions least = parsed("multi-pitch");
  EXPECT_EQ(least.ranges, 4);
  EXPECT_EQ(least.lift, 5.0);
  EXPECT_FALSE(least.step || least.overrun || least.smooth || least.min_pitch || least.max_pitch);
  const MultiPitchOptions some = parsed("multi-pitch:ranges=6,min-pitch=0.1,max-pitch=1");
  EXPECT_EQ(some.ranges, 6);
  EXPECT_EQ(some.min_pitch, 0.1);
  EXPECT_EQ(some.max_pitch, 1.0);
}

TEST(MultiPitch, RefusesTextsThatAreNone) {
  const auto message = [](const std::string& text) { return test::message_of([&] { parse_path_spec(text); }); };
  for (const char* list : {"1//2", "a/b", "1/", "/1", "nan"}) {
    EXPECT_EQ(message(std::string("multi-pitch:pitches=") + list),
              std::string("path \"multi-pitch:pitches=") + list + "\": pitches = \"" + list +
                  "\"; required numbers with slashes between, for instance 0.8/0.4/0.2");
  }
  for (const char* ranges : {"0", "101", "2.5", "-1", "inf", "1e16"}) {
    EXPECT_EQ(message(std::string("multi-pitch:ranges=") + ranges), std::string("path \"multi-pitch:ranges=") + ranges +
                                                                        "\": ranges = \"" + ranges +
                                                                        "\"; required a whole number, 1 to 100");
  }
  EXPECT_NE(message("multi-pitch:ranges=2,pitches=1/2").find("pitches or depths say how many ranges there are"),
            std::string::npos);
  EXPECT_NE(
      message("multi-pitch:max-feed=3").find("unknown key \"max-feed\"; accepted for multi-pitch: ranges, pitches"),
      std::string::npos);
}

TEST(MultiPitch, RefusesBadOptions) {
  const HeightMap map = stairs();
  const auto message = [&](const MultiPitchOptions& o, double feed = 50.0) {
    return test::message_of([&] { multi_pitch_path(map, tool(), feed, o); });
  };
  const auto with = [](auto set) {
    MultiPitchOptions o;
    set(o);
    return o;
  };
  EXPECT_EQ(message({}, kInf),
            "multi-pitch: the pitches follow from the fastest feed, which is inf mm/s; required: a fastest feed of the "
            "machine "
            "(`max feed` MM/MIN), or pitches=D1/D2/... in mm, shallowest first");
  EXPECT_EQ(message(given({0.5, -1.0}, 0.3)), "multi-pitch: pitches = -1 mm; required > 0");
  EXPECT_EQ(message(given({0.5, kInf}, 0.3)), "multi-pitch: pitches = inf mm; required finite");
  EXPECT_EQ(message(with([](auto& o) { o.depths = {3.0, 2.0}; })), "multi-pitch: depths = 3/2 nm; required ascending");
  EXPECT_EQ(message(with([](auto& o) { o.depths = {0.0}; })), "multi-pitch: depths = 0 nm; required > 0");
  EXPECT_EQ(message(with([](auto& o) {
              o.depths = {1.0};
              o.pitches = {1.0};
            })),
            "multi-pitch: 1 pitches and 1 depths between them; required one pitch more than depths");
  EXPECT_EQ(message(with([](auto& o) {
              o.pitches = {1.0};
              o.min_pitch = 1.0;
            })),
            "multi-pitch: pitches are given; min-pitch and max-pitch are accepted without them only");
  EXPECT_EQ(message(with([](auto& o) { o.ranges = 0; })), "multi-pitch: ranges = 0; required 1 to 100");
  EXPECT_EQ(message(with([](auto& o) { o.min_pitch = kNaN; })), "multi-pitch: min-pitch = nan mm; required > 0");
  EXPECT_EQ(message(with([](auto& o) { o.max_pitch = 0.0; })), "multi-pitch: max-pitch = 0 mm; required > 0");
  EXPECT_EQ(message(with([](auto& o) { o.min_pitch = 3.0; })),
            "multi-pitch: min-pitch = 3 mm; required at most max-pitch, 1 mm");
  EXPECT_EQ(message(with([](auto& o) { o.step = 0.0; })), "multi-pitch: step = 0 mm; required > 0");
  EXPECT_EQ(message(with([](auto& o) { o.angle_deg = kNaN; })), "multi-pitch: angle = nan degrees; required finite");
  EXPECT_EQ(message(with([](auto& o) { o.overrun = -1.0; })), "multi-pitch: overrun = -1 mm; required >= 0");
  EXPECT_EQ(message(with([](auto& o) { o.smooth = kInf; })), "multi-pitch: smooth = inf mm; required finite");
  EXPECT_EQ(message(with([](auto& o) { o.lift = 0.5; })), "multi-pitch: lift = 0.5 pitches; required >= 1");
  EXPECT_NE(message(with([](auto& o) { o.overrun = 1e9; })).find("at most 1e+08 accepted"), std::string::npos);
  EXPECT_EQ(test::message_of([] {
              multi_pitch_path(HeightMap(Grid{2, 2, 1.0, 1.0, {}}), tool(), 50.0, {});
            }),
            "multi-pitch: the map has no finite pixel; at least one is required");
}

TEST(MultiPitch, RefusesAbsurdCountsBeforeTheyAreMade) {
  const auto message = [&](double pitch, double step) {
    return test::message_of([&] { multi_pitch_path(stairs(), tool(), kInf, given({pitch}, step)); });
  };
  EXPECT_NE(message(1e-6, 1e-6).find("at most 5e+07 accepted in all"), std::string::npos);
  EXPECT_NE(message(1e-300, 1e-300).find("at most 5e+07 accepted in all"), std::string::npos);
  EXPECT_NE(message(1e-9, 10.0).find("at most 5e+07 accepted in all"), std::string::npos);
}

}  // namespace
}  // namespace dwell
