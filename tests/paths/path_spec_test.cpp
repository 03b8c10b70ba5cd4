#include "paths/path_spec.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/paths/path_test_util.h"

namespace dwell {
namespace {

std::string parse_message(const std::string& text) {
  return test::message_of([&] { parse_path_spec(text); });
}

RemovalFunction tool(double radius) { return gaussian_removal(1.0, 0.5 * radius, radius); }

TEST(PathSpec, ParsesARaster) {
  const auto full =
      std::get<RasterOptions>(parse_path_spec("raster:pitch=1,step=0.5,angle=30,overrun=5,order=one-way"));
  EXPECT_EQ(full.pitch, 1.0);
  EXPECT_EQ(full.step, 0.5);
  EXPECT_EQ(full.angle_deg, 30.0);
  EXPECT_EQ(full.overrun, 5.0);
  EXPECT_FALSE(full.serpentine);
  const auto least = std::get<RasterOptions>(parse_path_spec("raster:pitch=2"));
  EXPECT_FALSE(least.step.has_value());
  EXPECT_FALSE(least.overrun.has_value());
  EXPECT_EQ(least.angle_deg, 0.0);
  EXPECT_TRUE(least.serpentine);
  EXPECT_TRUE(std::get<RasterOptions>(parse_path_spec("raster:pitch=2,order=serpentine")).serpentine);
}

TEST(PathSpec, ParsesNearestAndFile) {
  const auto full =
      std::get<NearestOptions>(parse_path_spec("nearest:cell=1,critical=-3,lift=inf,start=-1.5/2e1,improve=2opt"));
  EXPECT_EQ(full.cell, 1.0);
  EXPECT_EQ(full.critical, -3.0);
  EXPECT_EQ(full.lift, test::kInf);
  EXPECT_EQ(full.start, (Point{-1.5, 20.0}));
  EXPECT_TRUE(full.improve);
  const auto least = std::get<NearestOptions>(parse_path_spec("nearest:cell=2"));
  EXPECT_EQ(least.critical, 0.0);
  EXPECT_EQ(least.lift, 1.5);
  EXPECT_FALSE(least.start.has_value());
  EXPECT_FALSE(least.improve);
  EXPECT_FALSE(std::get<NearestOptions>(parse_path_spec("nearest:cell=2,improve=none")).improve);
  EXPECT_EQ(std::get<PathFromFile>(parse_path_spec("file:a=1,b:c.csv")).file, "a=1,b:c.csv");
}

TEST(PathSpec, NamesWhatItDoesNotKnow) {
  EXPECT_EQ(parse_message("raster:ptich=1"),
            "path \"raster:ptich=1\": unknown key \"ptich\"; accepted for raster: pitch, step, angle, overrun, order");
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
            "path \"zigzag:pitch=1\": unknown kind \"zigzag\"; accepted: raster, nearest, file");
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
  EXPECT_EQ(test::message_of([&] {
              plan_path(parse_path_spec("raster:pitch=-1"), {map, tool(3.0)});
            }),
            "raster: pitch = -1 mm; required > 0");
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

}  // namespace
}  // namespace dwell
