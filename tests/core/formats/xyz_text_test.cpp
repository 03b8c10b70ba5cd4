#include "core/formats/xyz_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "core/formats/point_grid.h"
#include "core/map/value_units.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

HeightMap grid_of(const std::string& text, std::optional<Point> pitch = {}, std::optional<Point> origin = {}) {
  return grid_points(parse_xyz_text(text, "map a.xyz").points, pitch, origin, "map a.xyz", "map");
}

void expect_refused(const std::string& text, std::initializer_list<std::string> words) {
  test::expect_input_error([&] { grid_of(text); }, words);
}

TEST(XyzText, PutsPointsOfAnyOrderWhereTheyBelong) {
  // Rows are y and columns x: 2 x 3 pixels of 0.5 x 0.2 mm from (1, -2); (2, -2) is missing, (1.5, -1.8) without data.
  const HeightMap map = grid_of("2 -1.8 6\n1 -2 1\n1.5 -1.8 No Data\n1.5 -2 2\n1 -1.8 4\n");
  EXPECT_EQ(map.grid.rows, 2);
  EXPECT_EQ(map.grid.cols, 3);
  EXPECT_DOUBLE_EQ(map.grid.pitch_x, 0.5);
  EXPECT_DOUBLE_EQ(map.grid.pitch_y, 0.2);
  EXPECT_EQ(map.grid.origin, (Point{1.0, -2.0}));
  EXPECT_EQ(map.at(0, 0), 1.0);
  EXPECT_EQ(map.at(0, 1), 2.0);
  EXPECT_TRUE(std::isnan(map.at(0, 2)));
  EXPECT_EQ(map.at(1, 0), 4.0);
  EXPECT_TRUE(std::isnan(map.at(1, 1)));
  EXPECT_EQ(map.at(1, 2), 6.0);
}

TEST(XyzText, ReadsEverySeparatorAndAHeaderLine) {
  for (const std::string text :
       {"0 0 1\n1 0 2\n", "0,0,1\n1,0,2\n", "0;0;1\r\n1 ; 0 ; 2\r\n", "\t0\t0\t1\n1\t0\t2", "x,y,z\n0,0,1\n1,0,2\n",
        "X_mm Y_mm height_nm\n# note\n\n0 0 1\n+1 0 +2\n", "# x y z\n0 0 1\n1 0 2\n"}) {
    const HeightMap map = grid_of(text);
    ASSERT_EQ(map.grid.cols, 2) << text;
    ASSERT_EQ(map.grid.rows, 1) << text;
    EXPECT_EQ(map.grid.pitch_y, 1.0) << text;  // one row: the pitch of the other axis
    EXPECT_EQ(map.at(0, 0), 1.0) << text;
    EXPECT_EQ(map.at(0, 1), 2.0) << text;
  }
  EXPECT_TRUE(std::isnan(grid_of("0,0,1\n1,0,\n").at(0, 1)));
  EXPECT_EQ(parse_xyz_text("x_mm y_mm z_um\n0 0 1\n", "map").header.unit, "um");
}

TEST(XyzText, TakesTheUnitsOfItsColumnsInEverySpelling) {
  for (const std::string names :
       {"x_mm y_mm z_um", "x[mm]  y[mm]  z[um]", "# x[mm] y[mm] z[um]", "X (mm),Y (mm),Z (micron)",
        "# x/mm; y/mm; z/um", "\"X [mm]\",\"Y [mm]\",\"Z [\xc2\xb5m]\"", "x in mm, y in mm, z in um",
        "# x mm y mm height um", "# unit: um\nx y z", "# heights in um\n# x y z", "x y z[um]"}) {
    const XyzText xyz = parse_xyz_text(names + "\n0 0 1\n0.5 1 2\n", "map a.xyz");
    ASSERT_TRUE(xyz.header.unit.has_value()) << names;
    EXPECT_EQ(height_unit_nm(*xyz.header.unit), 1e3) << names;
    EXPECT_EQ(xyz.points[1].position, (Point{0.5, 1.0})) << names;
  }
}

TEST(XyzText, ConvertsCoordinatesToMillimetres) {
  for (const std::string names : {"# x (m)  y (m)  height (m)", "x_m y_m z_nm", "# lateral unit: m\n# unit: nm",
                                  "# x, y, z units: m", "# x,y in m, z in um", "# x: m, y: m, z: nm",
                                  "# x and y in metres; height in nm", "# xy units: metres\nx y z_um"}) {
    const XyzText xyz = parse_xyz_text(names + "\n0 0 1\n0.002 -0.001 2\n", "map a.xyz");
    EXPECT_DOUBLE_EQ(xyz.points[1].position.x, 2.0) << names;
    EXPECT_DOUBLE_EQ(xyz.points[1].position.y, -1.0) << names;
    EXPECT_TRUE(xyz.header.unit.has_value()) << names;
  }
  EXPECT_DOUBLE_EQ(parse_xyz_text("x_um y_um z\n250 0 1\n", "map").points[0].position.x, 0.25);
}

// "# Y [mm] X [mm] Z [nm]" was read as x y z with heights in mm: a million times too high, and turned.
TEST(XyzText, RefusesColumnsInAnotherOrderAndUnitsWithoutNames) {
  for (const std::string names :
       {"# Y [mm] X [mm] Z [nm]", "# y x z", "# y_mm x_mm z_nm", "# x z y", "# X [mm] Z [nm] Y [mm]", "# r theta z",
        "# row col z", "# x_mm,y_mm,z_um,weight", "# East(mm) North(mm) Up(um)", "# X_pos(mm) Y_pos(mm) Error(um)",
        "# mm mm um", "# (mm) (mm) (um)", "# [mm] [mm] [um]", "# um"}) {
    expect_refused(names + "\n0 0 1\n", {"map a.xyz, line 1", "names columns", "'x_mm y_mm z_nm'"});
  }
  for (const std::string prose : {"# scanned along x, then along y", "# row 7 was measured twice", "# line by line",
                                  "# by i and j", "# valid points only"}) {
    EXPECT_EQ(parse_xyz_text(prose + "\n0 0 1\n", "map a.xyz").points.size(), 1u) << prose;
  }
}

TEST(XyzText, RecognisesALineThatNamesItsColumns) {
  EXPECT_TRUE(names_xyz_columns("x y z\n1 2 3\n"));
  EXPECT_TRUE(names_xyz_columns("# made by hand\n# X_mm, Y_mm, Z_nm\n1,2,3\n"));
  EXPECT_FALSE(names_xyz_columns("1 2 3\nx y z\n"));
  EXPECT_FALSE(names_xyz_columns("# pitch_mm: 0.1\n1 2 3\n"));
  EXPECT_FALSE(names_xyz_columns("y x z\n1 2 3\n"));
  EXPECT_FALSE(names_xyz_columns("x y zebra\n1 2 3\n"));
}

TEST(XyzText, NamesTheLineItRefuses) {
  expect_refused("0 0 1\n1 0\n", {"map a.xyz, line 2", "'1 0'", "x y z"});
  expect_refused("0 0 1\n1 a 3\n", {"line 2", "'1 a 3'"});
  expect_refused("0 0 1\nnan 0 3\n", {"line 2", "x and y in mm, at most"});
  expect_refused("0 0 1\n1 inf 3\n", {"line 2", "x and y in mm, at most"});
  expect_refused("0 0 1\n1 0 inf\n", {"line 2, column 3", "infinite"});
  expect_refused("0 0 1\n1 0 3 4\n", {"line 2, column 3", "'3 4'"});
  expect_refused("0 0 1\n1,5 2,5 3,5\n", {"line 2"});
  expect_refused("# nothing\n", {"no point"});
  expect_refused("0 0 1\n#N/A 0 3\n", {"line 2", "'#N/A 0 3'"});
  expect_refused("hello\n0 0 1\n", {"line 1", "'hello'"});
  expect_refused("x_px y_px z\n0 0 1\n", {"line 1", "'px'", "mm"});
  expect_refused("x_mm y_um z\n0 0 1\n", {"line 1", "'um'", "agree"});
  expect_refused("x_mm y z_nm\n0 0 1\n", {"line 1", "only one of x and y", "x_mm y_mm z_nm"});
  expect_refused("x, y, z [um]\n0 0 1\n", {"line 1", "'um'", "of z alone, or of all", "x_mm y_mm z_um"});
  expect_refused("x y z_counts\n0 0 1\n", {"line 1", "'counts'", "nm, um"});
  expect_refused("xpos ypos z(nm)\n0 0 1\n", {"line 1", "'xpos ypos z(nm)'", "'x_mm y_mm z_nm'"});
  expect_refused("0,0 0,0 1,5\n0,5 0,0 2,5\n", {"line 1", "'0,0 0,0 1,5'", "decimal commas", "points"});
  expect_refused("0,0\t1\t1,5\n", {"line 1", "'0,0\\t1\\t1,5'", "decimal commas"});
  expect_refused("# unit: nm\nx y z_um\n0 0 1\n", {"line 2", "'um'", "'nm'"});
}

/// Four columns and three rows, no two distances alike.
std::string points_after(const std::string& comment) {
  std::string text = comment + "\n";
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) text += fmt::format("{} {} {}\n", x * 0.5, y * 0.25, (7 * x + y) % 5);
  }
  return text;
}

TEST(XyzText, TakesTheUnitOfCoordinatesFromASentence) {
  const auto pitch = [](const std::string& comment) {
    const test::TemporaryFolder folder;
    const Grid grid = read_map(folder.file("a.xyz", points_after(comment))).grid;
    return Point{grid.pitch_x, grid.pitch_y};
  };
  for (const char* inches : {"# coordinates in inches", "# coordinates are in inches",
                             "# x and y coordinates in inches", "# xy in inches"}) {
    EXPECT_NEAR(pitch(inches).x, 12.7, 1e-9) << inches;
    EXPECT_NEAR(pitch(inches).y, 6.35, 1e-9) << inches;
  }
  EXPECT_NEAR(pitch("# everything in um").x, 0.0005, 1e-12);
  EXPECT_NEAR(pitch("# Koordinaten in cm").y, 2.5, 1e-9);
  EXPECT_EQ(pitch("# coordinates in mm"), (Point{0.5, 0.25}));
  EXPECT_EQ(pitch("# measured by Anna, 20 C"), (Point{0.5, 0.25}));
}

TEST(XyzText, TakesAUnitOfEverything) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("a.xyz", "# all in metres\n0 0 1e-6\n0.002 0 2e-6\n0 0.001 3e-6\n0.002 0.001 5e-6\n");
  const HeightMap map = read_map(file);
  EXPECT_NEAR(map.grid.pitch_x, 2.0, 1e-12);
  EXPECT_NEAR(map.grid.pitch_y, 1.0, 1e-12);
  EXPECT_NEAR(map.at(1, 1), 5e3, 1e-9);
}

// "unit: um" is of the heights, unless the places would make a part that hardly anybody has.
TEST(XyzText, AsksWhetherAUnitIsOfPlacesTooWhereThePartWouldBeHuge) {
  const auto unclear = [](const std::string& header, const std::string& far) {
    return parse_xyz_text(header + "\n0 0 1\n" + far + " 0 2\n0 3 4\n" + far + " 3 1\n", "map a.xyz").header.unclear;
  };
  EXPECT_TRUE(unclear("# unit: um", "900").empty());
  ASSERT_EQ(unclear("# unit: um", "1100").size(), 1u);
  EXPECT_EQ(unclear("# unit: nm", "1100").front().about, UnclearStatement::About::Places);
  EXPECT_TRUE(unclear("# x_mm y_mm z_um", "1100").empty());
  EXPECT_TRUE(unclear("# heights in um", "1100").empty());
}

TEST(XyzText, RefusesPlacesInAUnitThatIsNotClear) {
  const test::TemporaryFolder folder;
  for (const char* comment : {"# pixel indices, 0.1 mm per pixel", "# all lengths in m", "# x and y in pixels",
                              "# data in inches", "# unit: m", "# lateral positions in um, heights in nm"}) {
    MapReadOptions options;
    const auto file = folder.file("a.xyz", points_after(comment));
    test::expect_input_error([&] { read_map(file, options); }, {"a.xyz, line 1", "mm"});
    options.scale =
        comment == std::string("# unit: m") || comment == std::string("# data in inches") ? options.scale : 1.0;
    options.pitch = square_pitch(0.5);
    test::expect_input_error([&] { read_map(file, options); }, {"a.xyz, line 1"});
  }
}

// Points say where they lie, but not whether that is before a shift, or which way y points.
TEST(XyzText, AsksWhetherThePlacesAreThoseOfThePart) {
  const test::TemporaryFolder folder;
  const std::string points = "1 2 5\n2 2 6\n1 3 7\n2 3 8\n";
  MapReadOptions shift, axes;
  shift.origin = Point{1.0, 2.0};
  axes.rows = MapRows::Bottom;
  struct Case {
    const char *line, *option;
    const MapReadOptions& settled;
  };
  for (const Case& c :
       {Case{"# x offset: 10 mm", "`map origin`", shift}, Case{"# shifted by 3 mm", "`map origin`", shift},
        Case{"# y axis down", "`map rows`", axes}, Case{"# rotated by 90 deg", "`map rows`", axes},
        Case{"# viewed from the back", "`map rows`", axes}}) {
    const auto file = folder.file("a.xyz", std::string(c.line) + "\n" + points);
    test::expect_input_error([&] { read_map(file); }, {"a.xyz, line 1", c.option});
    EXPECT_EQ(read_map(file, c.settled).at(1, 1), 8.0) << c.line;
  }
  for (const char* line : {"# extent: 1 2 2 3", "# centre: 1.5, 2.5", "# row 0 = top", "# x offset: 0 mm"}) {
    EXPECT_EQ(read_map(folder.file("b.xyz", std::string(line) + "\n" + points)).at(1, 1), 8.0) << line;
  }
  axes.rows = MapRows::Top;
  test::expect_input_error([&] { read_map(folder.file("c.xyz", "# y axis down\n" + points), axes); },
                           {"`map rows` is for a matrix"});
}

TEST(PointGrid, NamesPointsOffTheGridAndPointsGivenTwice) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 5; ++col) text += std::to_string(col) + " " + std::to_string(row) + " 1\n";
  }
  expect_refused(text + "2.4 3 1\n", {"line 21", "x = 2.4 mm", "regular grid"});
  expect_refused(text + "2 1.7 1\n", {"line 21", "y = 1.7 mm", "regular grid"});
  expect_refused(text + "3 2 1\n", {"line 21", "(3, 2)", "line 14"});
  expect_refused(text + "3 900000 1\n", {"21 points", "900001 x 5", "stray"});
  expect_refused("1 1 5\n", {"one place", "`map pixel`"});
}

TEST(PointGrid, RefusesScatteredPoints) {
  // Random places of one decimal: the grid of the last digit holds them all and is nearly empty.
  std::string random, jittered, ring, tracks;
  unsigned dice = 1;
  const auto roll = [&dice](unsigned sides) { return (dice = dice * 1664525U + 1013904223U) / 65536U % sides; };
  for (int i = 0; i < 60; ++i) random += fmt::format("{} {} {}\n", roll(100) * 0.1, roll(100) * 0.1, i);
  for (int i = 0; i < 25; ++i) {
    jittered += fmt::format("{:.2f} {:.2f} {}\n", i % 5 + 0.01 * roll(7) - 0.03, i / 5 + 0.01 * roll(7) - 0.03, i);
  }
  expect_refused(random, {"map a.xyz", "60 points fill", "pitch 0.1 x 0.1 mm", "25 % are required", "`map grid`"});
  expect_refused(jittered, {"map a.xyz", "25 points", "`map grid`"});
  // A ring fills little of its square but lies side by side, and so do tracks with wide gaps.
  int points = 0;
  for (int y = -50; y <= 50; ++y) {
    for (int x = -50; x <= 50; ++x) {
      const int square = x * x + y * y;
      if (square >= 46 * 46 && square <= 50 * 50) ring += fmt::format("{} {} 1\n", x * 0.1, y * 0.1), ++points;
    }
  }
  EXPECT_EQ(grid_of(ring).valid_pixels(), points);
  for (int i = 0; i < 40; ++i) tracks += fmt::format("{} {} 1\n", i % 20 * 0.1, i / 20 * 5);
  EXPECT_EQ(grid_of(tracks).valid_pixels(), 40);
}

TEST(PointGrid, RefusesPointsThatAreAbsurdlyFarApart) {
  // Two rows of two columns; as the difference overflows, x was once taken for one column.
  expect_refused("-1.5e308 0 1\n1.5e308 1 2\n", {"line 1", "at most 1000000000000 mm from 0"});
  expect_refused("0 0 1\n1 0 2\n0 1e300 3\n", {"line 3", "from 0"});
  expect_refused("0 0 1\n1 1 2\n2 2 3\n1e12 1e12 4\n", {"1000000000001 x 1000000000001", "stray"});
  const auto refused_on = [](const std::string& text, Point pitch, Point origin) {
    test::expect_input_error([&] { grid_of(text, pitch, origin); }, {"map a.xyz"});
  };
  refused_on("0 0 1\n1 1 2\n", {1e-300, 1e-300}, {0, 0});
  refused_on("0 0 1\n1 1 2\n", {5e-324, 1}, {-1e308, 0});
  refused_on("0 0 1\n1 1 2\n", {5e-324, 1}, {1e308, 0});
}

TEST(PointGrid, RefusesCoordinatesThatAreOneOnlyForACoarserPitch) {
  // x differs by 1e-7 of itself, which rounding explains; but it is 50 times the pitch that the points have in y.
  expect_refused("1000000 0 1\n1000000.05 0.001 2\n", {"line 2", "x = 1000000.05 mm", "regular grid"});
  expect_refused("0 1000000 1\n0.001 1000000.05 2\n", {"line 2", "y = 1000000.05 mm", "regular grid"});
  test::expect_input_error([] { grid_of("1000000 0 1\n1000000.05 0 2\n", Point{0.001, 0.001}); }, {"line 2", "grid"});
  EXPECT_EQ(grid_of("1000000 0 1\n1000000.0000001 0.001 2\n").grid.cols, 1);
}

TEST(PointGrid, AKnownPitchMustAgree) {
  const std::string text = "0 0 1\n0.5 0 2\n0 0.5 3\n";
  EXPECT_EQ(grid_of(text, Point{0.5, 0.5}).grid.pitch_x, 0.5);
  EXPECT_EQ(grid_of(text, Point{0.5002, 0.5002}).grid.pitch_x, 0.5);
  test::expect_input_error([&] { grid_of(text, Point{0.25, 0.25}); }, {"pitch of 0.5 mm", "`map pixel`", "0.25"});
  test::expect_input_error([&] { grid_of(text, Point{0.5, 0.51}); }, {"pitch of 0.5 mm in y", "0.51"});
  test::expect_input_error([&] { grid_of(text, {}, Point{0.0, 0.5}); }, {"begin at y = 0 mm", "`map origin`", "0.5"});
  EXPECT_EQ(grid_of("1 1 5\n", Point{0.5, 0.25}).grid.pitch_y, 0.25);
}

TEST(PointGrid, AKnownPitchAndOriginAreTheGrid) {
  const HeightMap map = grid_of("0.5 1 7\n", Point{0.5, 0.5}, Point{0.0, 0.0});
  EXPECT_EQ(map.grid.rows, 3);
  EXPECT_EQ(map.grid.cols, 2);
  EXPECT_EQ(map.at(2, 1), 7.0);
  EXPECT_EQ(map.valid_pixels(), 1);
  test::expect_input_error(
      [] {
        grid_of("0.5 1 7\n-0.5 0 1\n", Point{0.5, 0.5}, Point{0.0, 0.0});
      },
      {"line 2", "x = -0.5 mm"});
}

}  // namespace
}  // namespace dwell
