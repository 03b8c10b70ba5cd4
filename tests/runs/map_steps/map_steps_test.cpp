#include "runs/map_steps/map_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "core/base/grid_limit.h"
#include "core/base/whole_file.h"
#include "core/map/map_arithmetic.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::TemporaryFolder;
using test::uneven_map;

HeightMap prepared(HeightMap map, const std::string& steps, std::vector<InputFile>* inputs = nullptr) {
  std::vector<InputFile> unused;
  MapStepContext context{{}, inputs ? inputs : &unused, 1, {}};
  apply_map_steps(map, parse_map_steps(steps), context);
  return map;
}

bool in_last(const HeightMap& map, const std::string& words) {
  return map.history.back().find(words) != std::string::npos;
}

TEST(MapSteps, AppendOneLineEachThatSaysArgumentsAndWhatWasDone) {
  const HeightMap map = prepared(uneven_map(), "crop:rect:-1,2.4,9,9; fill ;outliers:4;rotate:90;");
  ASSERT_EQ(map.history.size(), 5u);
  EXPECT_EQ(map.history[0], "measured");
  EXPECT_EQ(map.history[1], "crop:rect:-1,2.4,9,9 (8 x 13 pixels, 97 with data)");
  EXPECT_EQ(map.history[2], "fill:how=harmonic (1 hole of 4 pixels filled)");
  EXPECT_EQ(map.history[3].substr(0, 46), "outliers:sigmas=4,window=5,floor=0 (0 pixels r");
  EXPECT_EQ(map.grid.rows, 13);
}

TEST(MapSteps, EveryExampleParsesAndItsHistoryTextParsesToTheSame) {
  std::set<std::string> names;
  for (const MapStepRecord& record : map_step_table()) {
    EXPECT_TRUE(names.insert(record.name).second) << record.name;
    const MapStep step = parse_map_step(record.example, map_step_table());
    EXPECT_EQ(step.record->name, record.name);
    const std::string all = to_string(step, true);
    EXPECT_EQ(to_string(parse_map_step(all, map_step_table()), true), all);
  }
}

TEST(MapSteps, RemoveBlemishesOfAScale) {
  HeightMap map(Grid{70, 90, 0.2, 0.3, {1.0, 2.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 30.0 * std::sin(0.3 * p.x) + 2.0 * p.y + std::sin(40.0 * p.x * p.y);
  }
  map.at(30, 40) -= 80.0, map.at(30, 41) -= 90.0, map.at(31, 41) -= 70.0;
  const HeightMap cleaned = prepared(map, "blemishes:width=4");
  EXPECT_TRUE(in_last(cleaned, "blemishes:width=4,sigmas=8 (1 blemishes of 3 pixels removed: "))
      << cleaned.history.back();
  EXPECT_TRUE(in_last(cleaned, " nm at (9.133, 11.1) mm)")) << cleaned.history.back();
  EXPECT_EQ(cleaned.valid_pixels(), map.valid_pixels() - 3);
  EXPECT_TRUE(std::isnan(cleaned.at(31, 41)));
  EXPECT_TRUE(in_last(prepared(map, "blemishes:4,sigmas=100"), "(0 blemishes of 0 pixels removed)"));
  expect_input_error([&] { prepared(map, "blemishes"); }, {"blemishes", "width"});
  expect_input_error([&] { prepared(map, "blemishes:width=-1"); }, {"step 'blemishes:width=-1", "width", "> 0"});
}

// Every step that can make a larger map than it is given asks the one limit before it takes the memory.
TEST(MapSteps, KeepWithinTheLimitOfPixels) {
  const auto within = [](double most, const std::string& step) {
    HeightMap map = uneven_map();  // 9 x 14 pixels of 0.2 x 0.3 mm
    std::vector<InputFile> inputs;
    MapReadOptions read;
    read.limit = {most};
    MapStepContext context{read, &inputs, 1, {}};
    apply_map_steps(map, parse_map_steps(step), context);
    return static_cast<double>(map.grid.size());
  };
  for (const std::string step :
       {"resample:0.1", "rotate:30", "extend:nearest,width=1", "fiducials:from=0/2.5/1/2.5,to=0/2.5/0.6/3.3"}) {
    const double made = within(kMaxPixels, step);
    EXPECT_GT(made, 9.0 * 14.0) << step;
    EXPECT_EQ(within(made, step), made) << step;
    expect_input_error([&] { within(made - 1.0, step); }, {step.substr(0, step.find(':')), "`max pixels`"});
  }
  expect_input_error([&] { within(700.0, "extend:gerchberg,width=1,shortest=9"); }, {"the transform", "to 700 pixels"});
}

/// Every step by name against the library call it stands for, or by what it must leave.
TEST(MapSteps, DoWhatTheirNamesSay) {
  const HeightMap map = uneven_map();
  const Point middle{-1.1 + 0.5 * 13 * 0.3, 2.3 + 0.5 * 8 * 0.2};
  EXPECT_EQ(prepared(map, "crop:data").grid, map.grid);
  EXPECT_EQ(prepared(map, "keep:rect:-1.1,2.3,-0.5,2.7").valid_pixels(), 9);
  EXPECT_EQ(prepared(map, "drop:rect:-1.1,2.3,-0.5,2.7").valid_pixels(), map.valid_pixels() - 9);
  EXPECT_EQ(prepared(map, "flip:x").at(2, 0), map.at(2, 13));
  EXPECT_EQ(prepared(map, "flip:y").at(0, 1), map.at(8, 1));
  EXPECT_EQ(prepared(map, "rotate:90").at(2, 0), map.at(8, 2));
  EXPECT_EQ(prepared(map, "rotate:-90").at(0, 2), map.at(2, 13));
  EXPECT_EQ(prepared(map, "rotate:540").at(8, 13), map.at(0, 0));
  test::expect_same_map(
      [&] {
        HeightMap same = prepared(map, "rotate:360");
        return same;
      }(),
      map);
  EXPECT_EQ(prepared(map, "transpose").at(5, 2), map.at(2, 5));
  const HeightMap about = prepared(map, "rotate:180,about=0/0");
  EXPECT_NEAR(about.grid.x(13), 1.1, 1e-12);
  EXPECT_NEAR(about.grid.y(8), -2.3, 1e-12);
  const HeightMap turned = prepared(map, "rotate:30");
  EXPECT_NEAR(0.5 * (turned.grid.x(0) + turned.grid.x(turned.grid.cols - 1)), middle.x, 1e-12);
  EXPECT_EQ(prepared(map, "fill:all").valid_pixels(), map.grid.size());
  EXPECT_TRUE(in_last(prepared(map, "fill:harmonic,largest=0.1"), "0 holes of 0 pixels filled, 1 larger ones left"));
  EXPECT_LT(prepared(map, "limit:height=5").valid_pixels(), map.valid_pixels());
  EXPECT_EQ(prepared(map, "decimate:2,factor-y=3").grid.rows, 3);
  EXPECT_EQ(prepared(map, "decimate:2,factor-y=3").grid.cols, 7);
  EXPECT_EQ(prepared(map, "resample:0.1").grid.rows, 17);
  EXPECT_EQ(prepared(map, "resample:0.1").grid.cols, 40);
  EXPECT_EQ(prepared(map, "resample:0.1,pitch-y=0.2").grid.rows, 9);
  for (const std::string how : {"zero", "nearest", "decay", "harmonic", "gerchberg"}) {
    EXPECT_GT(prepared(map, "extend:" + how + ",0.5").valid_pixels(), map.valid_pixels() + 50) << how;
  }
  EXPECT_TRUE(in_last(prepared(map, "extend:gerchberg,0.5,iterations=2"), "2 iterations, NOT settled"));
  const HeightMap shifted = prepared(map, "fiducials:shift,from=0/0/1/1,to=2/-1/3/0");
  EXPECT_NEAR(shifted.grid.origin.x, map.grid.origin.x + 2.0, 1e-12);
  EXPECT_NEAR(shifted.grid.origin.y, map.grid.origin.y - 1.0, 1e-12);
  EXPECT_EQ(shifted.valid_pixels(), map.valid_pixels());
}

TEST(MapSteps, SubtractAverageAndRegisterReadOtherMaps) {
  const TemporaryFolder folder;
  const Grid grid{60, 80, 0.3, 0.4, {-8.0, 5.0}};
  const auto height = [](double x, double y) {
    return 40.0 * std::sin(0.5 * x) * std::cos(0.4 * y) + 6.0 * std::sin(1.1 * x + 0.7 * y);
  };
  const HeightMap map = test::map_of(grid, height);
  const HeightMap twice = test::map_of(grid, [&](double x, double y) { return 2.0 * height(x, y) + 1.0; });
  const HeightMap moved = test::map_of(grid, [&](double x, double y) { return height(x + 0.7, y - 0.9); });
  const HeightMap finer = test::map_of({90, 130, 0.2, 0.3, {-9.0, 4.0}}, height);
  const auto file = [&](const char* name) { return (folder.path() / name).string(); };
  write_map(file("twice.csv"), twice), write_map(file("moved.csv"), moved), write_map(file("finer.csv"), finer);
  std::vector<InputFile> inputs;
  const HeightMap less = prepared(map, "subtract:" + file("twice.csv"), &inputs);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].role, "subtract");
  EXPECT_EQ(inputs[0].sha256, sha256_of_file(file("twice.csv")));
  EXPECT_NEAR(less.at(7, 9), -map.at(7, 9) - 1.0, 1e-9);
  const HeightMap mean = prepared(map, "average:" + file("twice.csv") + "," + file("twice.csv"));
  EXPECT_NEAR(mean.at(7, 9), (5.0 * map.at(7, 9) + 2.0) / 3.0, 1e-9);
  const HeightMap near = prepared(map, "subtract:" + file("finer.csv") + ",resample");
  for (const Index i : finite_pixels(near)) EXPECT_NEAR(near.values[static_cast<std::size_t>(i)], 0.0, 0.05);
  const HeightMap registered = prepared(moved, "register:" + file("finer.csv") + ",shift=1.5,no-level");
  EXPECT_EQ(grid_difference(registered.grid, finer.grid), "");
  EXPECT_NEAR(registered.at(45, 60), finer.at(45, 60), 0.05);
  EXPECT_TRUE(in_last(registered, "moved by 0.7")) << registered.history.back();
  EXPECT_TRUE(in_last(registered, " mm in x and -0.9")) << registered.history.back();
  const HeightMap left = prepared(map, "subtract:" + file("moved.csv") + ",register,shift=1.5");
  EXPECT_NEAR(left.at(30, 40), 0.0, 0.05);
  expect_input_error([&] { prepared(map, "subtract:" + file("finer.csv")); },
                     {"step 'subtract", "different grids", "resample"});
  expect_input_error([&] { prepared(map, "average:" + file("finer.csv")); },
                     {"finer.csv", "different grids", "resample"});
  EXPECT_GT(prepared(map, "average:" + file("finer.csv") + ",resample").valid_pixels(), 4000);
}

TEST(MapSteps, ReadOtherMapsOfPixelsThatAreNotSquare) {
  const test::TemporaryFolder folder;
  const HeightMap map(Grid{2, 3, 0.5, 0.25, {}}, {1.0, 2.0, 3.0, 4.0, 5.0, 7.0});
  const std::string file = folder.file("other.csv", "1,1,1\n0,0,2\n").string();
  const HeightMap less = prepared(map, "subtract:file=" + file + ",pixel=0.5/0.25");
  EXPECT_EQ(less.at(1, 2), 5.0);
  EXPECT_EQ(less.at(0, 1), 1.0);
  expect_input_error([&] { prepared(map, "subtract:file=" + file + ",pixel=0.25/0.5"); }, {"different grids"});
  for (const std::string wrong : {"0.5/0.25/1", "0.5/x", "-0.5", "0.5/0"}) {
    expect_input_error([&] { prepared(map, "subtract:file=" + file + ",pixel=" + wrong); },
                       {"pixel = '" + wrong + "'", "X/Y", "not square"});
  }
}

TEST(MapSteps, ReadOtherMapsInWavesByTheirOwnScale) {
  const test::TemporaryFolder folder;
  const HeightMap map(Grid{1, 3, 0.5, 0.5, {}}, {100.0, 200.0, 400.0});
  const std::string waves = folder.file("other.csv", "0.1,0.2,0.6\n").string(),
                    opd = folder.file("other_opd.csv", "1,2,6\n").string();
  const std::string in_waves = "subtract:file=" + waves + ",pixel=0.5,unit=waves";
  EXPECT_NEAR(prepared(map, in_waves + ",wavelength=500,wave-scale=0.5").at(0, 2), 400.0 - 150.0, 1e-9);
  expect_input_error([&] { prepared(map, in_waves); }, {"other.csv", "`wavelength` [nm] and `wave scale`"});
  expect_input_error([&] { prepared(map, in_waves + ",wavelength=0.5,wave-scale=0.5"); },
                     {"wavelength = 0.5", "from 100 to 20000 (nm)"});
  expect_input_error([&] { prepared(map, "subtract:file=" + opd + ",pixel=0.5"); }, {"other_opd.csv", "`wave scale`"});
  EXPECT_EQ(prepared(map, "subtract:file=" + opd + ",pixel=0.5,wave-scale=0.5").at(0, 2), 397.0);
}

TEST(MapSteps, RefuseNamingTheStepAndWhatIsAccepted) {
  const auto refused = [](const std::string& steps, std::initializer_list<std::string> words) {
    expect_input_error([&] { prepared(uneven_map(), steps); }, words);
  };
  refused("fil", {"step 'fil'", "unknown step", "crop, keep"});
  refused("crop", {"area is missing", "rect:X0"});
  refused("crop:circle:0,0,1", {"data or rect"});
  refused("keep:square:1", {"step 'keep:square:1'", "unknown form"});
  refused("rotate", {"degrees is missing", "rotate:degrees=DEG"});
  refused("rotate:x", {"degrees = 'x'", "finite number"});
  refused("rotate:nan", {"degrees = 'nan'"});
  refused("rotate:1,2,3", {"unknown argument '3'"});
  refused("rotate:90,about=1", {"about = '1'", "X/Y"});
  refused("flip:z", {"axis = 'z'", "x or y"});
  refused("fill:smooth", {"how = 'smooth'", "harmonic"});
  refused("fill:all=1", {"all takes no value"});
  refused("fill:largest=-1", {"largest = -1"});
  refused("fill:depth=1", {"unknown argument 'depth=1'", "[,largest=MM2]"});
  refused("outliers:window=2.5", {"window = 2.5", "whole number"});
  refused("outliers:4,sigmas=5", {"sigmas is given twice"});
  refused("limit", {"one > 0"});
}

TEST(MapSteps, RefuseHostileText) {
  for (const std::string& text :
       {std::string("fill\n"), std::string("subtract:a\x01.csv"), std::string("fill:\0", 6)}) {
    expect_input_error([&] { parse_map_steps("crop:data;" + text + "x"); }, {"control character"});
  }
  EXPECT_TRUE(parse_map_steps(" ; ").empty());
}

TEST(MapSteps, FileNamesAreTakenRelativeToAFolder) {
  const auto in_jobs = [](const std::string& file) { return (std::filesystem::path("/jobs") / file).string(); };
  EXPECT_EQ(renamed_map_steps("crop:data; subtract:file=a/b.csv,resample;average:x.csv,/y.csv,least=2", in_jobs),
            "crop:data; subtract:file=/jobs/a/b.csv,how=resample; average:/jobs/x.csv,/y.csv,least=2");
}

TEST(MapSteps, StopWhenTold) {
  std::vector<InputFile> inputs;
  MapStepContext context{{}, &inputs, 1, Progress{{}, [] { return true; }}};
  HeightMap map = uneven_map();
  EXPECT_THROW(apply_map_steps(map, parse_map_steps("fill"), context), Interrupted);
}

// One table of steps: docs/maps.md holds it as map_steps_markdown() gives it.
TEST(MapSteps, AreDescribedInTheDocuments) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/maps.md");
  EXPECT_NE(text.find(map_steps_markdown()), std::string::npos) << "docs/maps.md lacks this table:\n"
                                                                << map_steps_markdown();
  for (const MapStepRecord& record : map_step_table()) {
    EXPECT_NE(map_steps_help().find("--step '" + record.example + "'"), std::string::npos) << record.name;
  }
}

}  // namespace
}  // namespace dwell
