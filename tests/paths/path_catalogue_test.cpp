#include "paths/path_catalogue.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include "paths/curves/circles.h"
#include "paths/curves/fibonacci.h"
#include "paths/curves/spiral.h"
#include "paths/lines/cross_hatch.h"
#include "paths/lines/random_raster.h"
#include "paths/lines/raster.h"
#include "paths/tours/nearest_neighbour.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

std::string parse_message(const std::string& text) {
  return test::message_of([&] { parse_path_spec(text); });
}

RemovalFunction tool(double radius) { return gaussian_removal(1.0, 0.5 * radius, radius); }

TEST(PathSpec, ParsesARaster) {
  const auto full =
      options_of<RasterOptions>(parse_path_spec("raster:pitch=1,step=0.5,angle=30,overrun=5,order=one-way"));
  EXPECT_EQ(full.pitch, 1.0);
  EXPECT_EQ(full.step, 0.5);
  EXPECT_EQ(full.angle_deg, 30.0);
  EXPECT_EQ(full.overrun, 5.0);
  EXPECT_FALSE(full.serpentine);
  const auto least = options_of<RasterOptions>(parse_path_spec("raster:pitch=2"));
  EXPECT_FALSE(least.step.has_value());
  EXPECT_FALSE(least.overrun.has_value());
  EXPECT_EQ(least.angle_deg, 0.0);
  EXPECT_TRUE(least.serpentine);
  EXPECT_TRUE(options_of<RasterOptions>(parse_path_spec("raster:pitch=2,order=serpentine")).serpentine);
}

TEST(PathSpec, ParsesTurnarounds) {
  const auto turns = [](const std::string& text) {
    return options_of<RasterOptions>(parse_path_spec("raster:pitch=1" + text)).turns;
  };
  EXPECT_EQ(turns("").turn, Turnaround::Square);
  EXPECT_EQ(turns("").corner, 0.0);
  EXPECT_EQ(turns(",turn=arc,corner=0.3").turn, Turnaround::Arc);
  EXPECT_EQ(turns(",turn=arc,corner=0.3").corner, 0.3);
  EXPECT_EQ(turns(",turn=lift").turn, Turnaround::Lift);
  EXPECT_EQ(parse_message("raster:pitch=1,turn=u"),
            "path \"raster:pitch=1,turn=u\": turn = \"u\"; accepted: square, arc, lift");
}

TEST(PathSpec, ParsesCrossHatchAndRandomRaster) {
  const auto cross = options_of<CrossHatchOptions>(
      parse_path_spec("cross-hatch:pitch=1,step=0.5,angle=30,crossing=60,overrun=5,turn=arc,corner=0.1"));
  EXPECT_EQ(cross.pitch, 1.0);
  EXPECT_EQ(cross.step, 0.5);
  EXPECT_EQ(cross.angle_deg, 30.0);
  EXPECT_EQ(cross.crossing_deg, 60.0);
  EXPECT_EQ(cross.overrun, 5.0);
  EXPECT_EQ(cross.turns.turn, Turnaround::Arc);
  EXPECT_EQ(cross.turns.corner, 0.1);
  EXPECT_EQ(options_of<CrossHatchOptions>(parse_path_spec("cross-hatch:pitch=1")).crossing_deg, 90.0);
  const auto random = options_of<RandomRasterOptions>(parse_path_spec(
      "random-raster:pitch=1,spread=0.2,step=0.5,angle=30,overrun=5,order=one-way,turn=lift,corner=0.1,seed=7"));
  EXPECT_EQ(random.spread, 0.2);
  EXPECT_EQ(random.step, 0.5);
  EXPECT_EQ(random.angle_deg, 30.0);
  EXPECT_EQ(random.overrun, 5.0);
  EXPECT_FALSE(random.serpentine);
  EXPECT_EQ(random.turns.turn, Turnaround::Lift);
  EXPECT_EQ(random.turns.corner, 0.1);
  EXPECT_EQ(random.seed, 7u);
  EXPECT_EQ(options_of<RandomRasterOptions>(parse_path_spec("random-raster:pitch=1")).seed, 1u);
}

TEST(PathSpec, ParsesCurves) {
  const auto spiral =
      options_of<SpiralOptions>(parse_path_spec("spiral:pitch=2,step=0.5,overrun=5,centre=-1/2.5,from=edge,turn=cw"));
  EXPECT_EQ(spiral.pitch, 2.0);
  EXPECT_EQ(spiral.step, 0.5);
  EXPECT_EQ(spiral.overrun, 5.0);
  EXPECT_EQ(spiral.centre, (Point{-1.0, 2.5}));
  EXPECT_TRUE(spiral.from_edge);
  EXPECT_TRUE(spiral.clockwise);
  const auto circles = options_of<CirclesOptions>(parse_path_spec("circles:pitch=2"));
  EXPECT_FALSE(circles.step || circles.overrun || circles.centre || circles.from_edge || circles.clockwise);
  const auto fibonacci = options_of<FibonacciOptions>(parse_path_spec("fibonacci:pitch=2,overrun=3,centre=4/5"));
  EXPECT_EQ(fibonacci.pitch, 2.0);
  EXPECT_EQ(fibonacci.overrun, 3.0);
  EXPECT_EQ(fibonacci.centre, (Point{4.0, 5.0}));
  EXPECT_EQ(parse_message("spiral:pitch=1,turn=left"),
            "path \"spiral:pitch=1,turn=left\": turn = \"left\"; accepted: ccw, cw");
  EXPECT_EQ(parse_message("fibonacci:pitch=1,seed=1"),
            "path \"fibonacci:pitch=1,seed=1\": unknown key \"seed\"; accepted for fibonacci: pitch, overrun, centre");
}

TEST(PathCatalogue, EveryPlannerWithAnOverrunTakesTheTifRadiusForIt) {
  const HeightMap map = test::full_map(5, 9, 1.0, 1.0, {3.0, -2.0});
  int planners = 0;
  for (const PathRecord& record : path_catalogue()) {
    if (record.usage.find("overrun=") == std::string::npos) continue;  // it plans on the part alone, or reads a file
    ++planners;
    const auto plan = [&](const std::string& overrun) {
      const std::string spacing = record.spacing.empty() ? "" : record.spacing + "=1";
      const std::string options = spacing + (spacing.empty() || overrun.empty() ? "" : ",") + overrun;
      return plan_path(parse_path_spec(record.name + (options.empty() ? "" : ":") + options), {map, tool(3.0), 50.0});
    };
    const ToolPath path = plan("");
    EXPECT_EQ(path.kind, record.name);
    EXPECT_EQ(path.points, plan("overrun=3").points) << record.name;
    EXPECT_GT(path.size(), plan("overrun=0").size()) << record.name;
  }
  EXPECT_GE(planners, 10);
}

TEST(PathSpec, ParsesNearestAndFile) {
  const auto full =
      options_of<NearestOptions>(parse_path_spec("nearest:cell=1,critical=-3,lift=inf,start=-1.5/2e1,improve=2opt"));
  EXPECT_EQ(full.cell, 1.0);
  EXPECT_EQ(full.critical, -3.0);
  EXPECT_EQ(full.lift, test::kInf);
  EXPECT_EQ(full.start, (Point{-1.5, 20.0}));
  EXPECT_TRUE(full.improve);
  const auto least = options_of<NearestOptions>(parse_path_spec("nearest:cell=2"));
  EXPECT_EQ(least.critical, 0.0);
  EXPECT_EQ(least.lift, 1.5);
  EXPECT_FALSE(least.start.has_value());
  EXPECT_FALSE(least.improve);
  EXPECT_FALSE(options_of<NearestOptions>(parse_path_spec("nearest:cell=2,improve=none")).improve);
  EXPECT_EQ(options_of<PathFromFile>(parse_path_spec("file:a=1,b:c.csv")).file, "a=1,b:c.csv");
}

TEST(PathSpec, NamesWhatItDoesNotKnow) {
  EXPECT_EQ(parse_message("raster:ptich=1"),
            "path \"raster:ptich=1\": unknown key \"ptich\"; accepted for raster: pitch, ripple, step, angle, overrun, "
            "order, turn, corner");
  EXPECT_EQ(parse_message("nearest:cell=1,pitch=1"),
            "path \"nearest:cell=1,pitch=1\": unknown key \"pitch\"; accepted for nearest: cell, critical, lift, "
            "start, improve");
  EXPECT_EQ(parse_message("raster"), "path \"raster\": pitch is missing; raster:pitch=NUMBER is required");
  EXPECT_EQ(parse_message("nearest:critical=1"),
            "path \"nearest:critical=1\": cell is missing; nearest:cell=NUMBER is required");
  EXPECT_EQ(parse_message("raster:pitch=1,order=zigzag"),
            "path \"raster:pitch=1,order=zigzag\": order = \"zigzag\"; accepted: serpentine, one-way");
  EXPECT_EQ(parse_message("nearest:cell=1,improve=3opt"),
            "path \"nearest:cell=1,improve=3opt\": improve = \"3opt\"; accepted: none, 2opt");
  EXPECT_EQ(parse_message("zigzag:pitch=1"),
            "path \"zigzag:pitch=1\": unknown kind \"zigzag\"; accepted: raster, cross-hatch, random-raster, spiral, "
            "circles, fibonacci, nearest, random, hilbert, peano, multi-pitch, line, file");
  EXPECT_EQ(parse_message("file:"), "path \"file:\": the name of a file is missing; required: file:PATH.csv");
  for (const char* start : {"5", "5/", "/5", "a/b", "1/2/3"}) {
    const std::string text = std::string("nearest:cell=1,start=") + start;
    EXPECT_EQ(parse_message(text),
              "path \"" + text + "\": start = \"" + start + "\"; required X/Y in mm, for instance start=-10/2.5");
  }
}

TEST(PathSpec, PlansWithTheTifRadiusAsOverrunUnlessGiven) {
  const HeightMap map = test::full_map(1, 11);
  EXPECT_EQ(plan_path(parse_path_spec("raster:pitch=1"), {map, tool(3.0)}).points.front().y, -3.0);
  EXPECT_EQ(plan_path(parse_path_spec("raster:pitch=1,overrun=0"), {map, tool(3.0)}).size(), 11u);
  EXPECT_EQ(plan_path(parse_path_spec("nearest:cell=1"), {map, tool(3.0)}).kind, "nearest");
  // Only the planners over a square lattice have as many points as pixels here.
  for (const char* kind : {"random", "hilbert", "peano"}) {
    const std::string text = std::string(kind) + ":pitch=1,overrun=0";
    EXPECT_EQ(plan_path(parse_path_spec(text), {map, tool(3.0)}).size(), 11u) << kind;
  }
  EXPECT_EQ(test::message_of([&] {
              plan_path(parse_path_spec("raster:pitch=-1"), {map, tool(3.0)});
            }),
            "raster: pitch = -1 mm; required > 0");
}

TEST(PathSpec, FindsThePitchOfARaster) {
  const auto options = options_of<RasterOptions>(parse_path_spec("raster:pitch=auto,ripple=0.02"));
  EXPECT_TRUE(options.auto_pitch);
  EXPECT_EQ(options.ripple, 0.02);
  EXPECT_FALSE(options_of<RasterOptions>(parse_path_spec("raster:pitch=1")).auto_pitch);
  const HeightMap map = test::full_map(30, 41);
  const ToolPath path = plan_path(parse_path_spec("raster:pitch=auto,step=1,overrun=0"), {map, tool(6.0)});
  ASSERT_EQ(path.notes.size(), 1u);
  // FWHM 3 mm: the widest pitch with 4 exp(-2 (pi sigma / d)^2) <= 1 % is 1.8 sigma = 2.3 mm.
  EXPECT_NE(path.notes[0].find("chosen as the widest that leaves a ripple of at most 1 % of the removal"),
            std::string::npos);
  EXPECT_NEAR(path.points[41].y - path.points[0].y, 2.31, 0.02);
  EXPECT_EQ(parse_message("raster:pitch=automatic"),
            "path \"raster:pitch=automatic\": pitch = \"automatic\"; required a number in mm, or auto");
  EXPECT_EQ(parse_message("raster:pitch=1,ripple=0.1"),
            "path \"raster:pitch=1,ripple=0.1\": ripple = \"0.1\"; required pitch=auto with it");
  EXPECT_EQ(test::message_of([&] {
              plan_path(parse_path_spec("raster:pitch=auto,ripple=2"), {map, tool(6.0)});
            }),
            "raster: ripple = 2; required > 0 and < 1 (peak to valley over removal)");
}

TEST(PathSpec, PlansAMultiPitchRasterForTheFeed) {
  HeightMap map = test::full_map(20, 21);
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = static_cast<double>(i % 21);
  EXPECT_NE(test::message_of([&] {
              plan_path(parse_path_spec("multi-pitch"), {map, tool(3.0)});
            }).find("required: a fastest feed"),
            std::string::npos);
  const ToolPath path = plan_path(parse_path_spec("multi-pitch:ranges=3"), {map, tool(3.0), 1.0, true});
  EXPECT_EQ(path.kind, "multi-pitch");
  ASSERT_EQ(path.notes.size(), 2u);
  EXPECT_NE(path.notes[1].find("eq. 12) the dwell would be "), std::string::npos);
}

TEST(PathSpec, RefusesTracksFartherApartThanTheToolIsWide) {
  const HeightMap map = test::full_map(20, 21);
  for (const char* text : {"raster:pitch=6.1", "raster:pitch=1,step=7", "spiral:pitch=500", "random:pitch=1e9",
                           "nearest:cell=6.5", "multi-pitch:pitches=1/9,depths=0.5", "circles:pitch=1,step=1e7"}) {
    const std::string message = test::message_of([&] { plan_path(parse_path_spec(text), {map, tool(3.0), 1.0}); });
    EXPECT_NE(message.find("required at most 6 mm, the removal function's diameter"), std::string::npos)
        << text << ": " << message;
  }
  EXPECT_GT(plan_path(parse_path_spec("raster:pitch=6"), {map, tool(3.0)}).size(), 3u);
}

TEST(PathSpec, SaysOfLongMovesWithTheToolDown) {
  const HeightMap map = test::map_from_picture({"11..........11", "11..........11"});
  const ToolPath path = plan_path(parse_path_spec("nearest:cell=1,lift=inf"), {map, tool(3.0)});
  ASSERT_EQ(path.notes.size(), 1u);
  EXPECT_EQ(
      path.notes[0],
      "1 move is longer than the removal function is wide and made with the tool down, 12 mm: it removes where it "
      "passes");
  EXPECT_TRUE(plan_path(parse_path_spec("nearest:cell=1"), {map, tool(3.0)}).notes.empty());
}

TEST(PathSpec, RefusesAFileWhollyOutsideThePart) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "dwell_path_spec_outside.csv";
  std::ofstream(file) << "x_mm,y_mm\n100,200\n101,200\n";
  const HeightMap map = test::full_map(5, 9);
  const PathSpec spec = parse_path_spec("file:" + file.string());
  EXPECT_EQ(
      test::message_of([&] {
        plan_path(spec, {map, tool(2.0)});
      }),
      file.string() +
          ": the path lies wholly outside the part: its points have x 100 to 101 and y 200 to 200 mm, the map x 0 "
          "to 8 and y 0 to 4 mm, and the removal function reaches 2 mm; required: a path in the map's coordinates");
  EXPECT_EQ(plan_path(spec, {map, tool(160.0)}).size(), 2u);
  std::ofstream(file)
      << "x_mm,y_mm\n-60,2\n68,2\n";  // both points far away, but the move between them crosses the part
  EXPECT_EQ(plan_path(spec, {map, tool(2.0)}).kind, "file");
  std::filesystem::remove(file);
}

TEST(PathCatalogue, RowsAreWhole) {
  std::set<std::string> names;
  for (const PathRecord& record : path_catalogue()) {
    EXPECT_TRUE(names.insert(record.name).second) << record.name;
    EXPECT_FALSE(record.usage.empty() || record.about.empty()) << record.name;
    EXPECT_TRUE(record.spacing.empty() || record.usage.starts_with(record.spacing + "=MM")) << record.name;
  }
}

TEST(PathCatalogue, NoPlannerEscapesTheCheckAgainstTheTool) {
  const HeightMap map = test::full_map(20, 21);
  for (const PathRecord& record : path_catalogue()) {
    if (record.spacing.empty()) continue;  // multi-pitch and file have tests of their own
    const std::string text = record.name + ":" + record.spacing + "=6.1";
    EXPECT_EQ(test::message_of([&] {
                plan_path(parse_path_spec(text), {map, tool(3.0), 1.0});
              }),
              "path: " + record.spacing +
                  " = 6.1 mm; required at most 6 mm, the removal function's diameter: farther apart, there are places "
                  "that the tool never touches")
        << text;
  }
}

TEST(PathCatalogue, SpecsAreWrittenBackAsTheyWereRead) {
  for (const char* text : {"raster:pitch=1,angle=30", "multi-pitch", "file:a=1,b:c.csv"}) {
    const PathSpec spec = parse_path_spec(text);
    EXPECT_EQ(to_string(spec), text);
    EXPECT_EQ(parse_path_spec(to_string(spec)).record, spec.record);
  }
  EXPECT_EQ(parse_path_spec("random:pitch=1").record->name, "random");
  EXPECT_EQ(parse_path_spec("random:pitch=1").get_if<RasterOptions>(), nullptr);
  EXPECT_FALSE(PathSpec{}.given());
  EXPECT_EQ(to_string(PathSpec{}), "");
  const HeightMap map = test::full_map(2, 2);
  EXPECT_THROW(plan_path(PathSpec{}, {map, tool(3.0)}), std::logic_error);
}

}  // namespace
}  // namespace dwell
