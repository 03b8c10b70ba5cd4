#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "paths/feed/cubic_check.h"
#include "runs/programs/pmac_program.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/pvt_csv.h"
#include "runs/programs/pvt_hdf5.h"
#include "runs/programs/pvt_json.h"
#include "runs/programs/pvt_table.h"
#include "runs/programs/xps_trajectory.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/runs/programs/program_cases.h"
#include "tests/runs/programs/pvt_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::replaced;
using pvt_cases::lifted_motion;
using pvt_cases::made_by;
using pvt_cases::slow_machine;

/// The program of a plan in one format, written into a folder and read from there.
Program through_files(const std::string& word, const Program& motion, const test::TemporaryFolder& folder) {
  std::string first;
  for (const WrittenProgram& file : written_programs({made_by(), motion}, {}, {word})) {
    if (file.word != word) continue;
    if (first.empty()) first = file.file;
    folder.file(file.file, file.bytes);
  }
  return read_program(folder.path() / first);
}

std::vector<ProgramStep> at_work(const Program& program) {
  std::vector<ProgramStep> steps;
  for (const ProgramStep& step : program.steps) {
    if (step.removes) steps.push_back(step);
  }
  return steps;
}

TEST(PvtFormats, EachReadsBackTheMotionWithinTheLimits) {
  const Program motion = lifted_motion();
  const Program table = program_of(pvt_table_of(motion), "");
  EXPECT_NEAR(table.total_seconds(), motion.total_seconds(), 1e-6);
  for (const ProgramFormat& format : program_formats()) {
    if (format.word.empty() || format.in_frame) continue;  // those of feeds: speed_gcode_test.cpp
    const test::TemporaryFolder folder;
    const Program read = through_files(format.word, motion, folder);
    EXPECT_EQ(read.file, (folder.path() / format.file).string());
    EXPECT_NEAR(read.total_seconds(), table.total_seconds(), 1e-6) << format.word;
    const auto faults = cubics_beyond_machine(read, slow_machine());
    EXPECT_TRUE(faults.empty()) << format.word << ": " << (faults.empty() ? "" : faults[0]);
    if (format.word == "pmac") continue;  // cuts long halts
    const auto i = at_work(read), j = at_work(table);
    ASSERT_EQ(i.size(), j.size()) << format.word;
    for (std::size_t k = 0; k < i.size(); ++k) {
      EXPECT_NEAR(distance(i[k].finish, j[k].finish), 0.0, 1e-9) << format.word << k;
      EXPECT_NEAR(i[k].seconds, j[k].seconds, 2e-9) << format.word << k;
      EXPECT_EQ(i[k].speeds, j[k].speeds) << format.word << k;
    }
    EXPECT_NE(i.size(), read.steps.size()) << "no lifted way";
  }
}

TEST(PvtFormats, CanHaveNoVelocityThatJumps) {
  Program motion;
  motion.steps = {{{0, 0}, {1, 0}, 1.0, true}};
  expect_contains(input_error([&] { pvt_table_of(motion); }), "the velocity jumps after step 0");
  motion.steps = {{{0, 0}, {1, 0}, 0.0, false}};
  expect_contains(input_error([&] { pvt_table_of(motion); }), "takes no time for 1 mm");
}

TEST(PvtCsv, IsWhatTheDocumentsSay) {
  PvtTable table;
  table.rows = {{0.0, {-1.0, 2.0}, {}, true}, {0.5, {0.0, 2.0}, {2.0, -0.25}, false}, {1.25, {1.5, 2.0}, {}, false}};
  EXPECT_EQ(
      pvt_csv_text(table, made_by()),
      "# pvt: dwell 0.0\n# units: t s, x and y mm, vx and vy mm/s\n# rows: 3\n# total_s: 1.250000000\n"
      "# lift: 1 where the way to the row is made with the tool lifted, in rest at its ends; lifting and lowering "
      "take their time besides\n"
      "# input: map mirror (2).csv sha256=" +
          std::string(64, 'a') +
          "\n# option: tif_centre = centroid\n"
          "t_s,x_mm,vx_mm_per_s,y_mm,vy_mm_per_s,lift\n"
          "0.000000000,-1.000000,0.000000,2.000000,0.000000,1\n"
          "0.500000000,0.000000,2.000000,2.000000,-0.250000,0\n"
          "1.250000000,1.500000,0.000000,2.000000,0.000000,0\n");
}

const char* const kBare = "# units: t s, x and y mm, vx and vy mm/s\nt,x,vx,y,vy\n0,0,0,5,0\n1,2,3,4,-0.5\n2,4,0,4,0\n";

TEST(PvtCsv, ReadsOthersWithoutALiftAtWork) {
  const Program program = program_of(parse_pvt_csv(kBare, "f"), "f");
  ASSERT_EQ(program.steps.size(), 2U);
  EXPECT_TRUE(program.steps[0].removes);
  EXPECT_EQ(program.steps[0].speeds->out, (Point{3.0, -0.5}));
  EXPECT_EQ(program.steps[0].start, (Point{0.0, 5.0}));
}

TEST(PvtCsv, RefusesWhatItWouldMisread) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& says) {
    const std::string text = replaced(kBare, from, to);
    expect_contains(input_error([&] { parse_pvt_csv(text, "f.csv"); }), says);
  };
  refused("x and y mm", "x and y um", "f.csv, line 1: units = 't s, x and y um, vx and vy mm/s'; accepted: t s");
  refused("# units: t s, x and y mm, vx and vy mm/s\n", "", "line 1: column line \"t,x,vx,y,vy\"; accepted: t_s,x_mm");
  refused("t,x,vx,y,vy", "t,x,y,vx,vy", "column line \"t,x,y,vx,vy\"");
  refused("1,2,3,4,-0.5", "1,2,3,4", "line 4: 4 columns; required 5");
  refused("1,2,3,4,-0.5", "1,2,3,4,-0.5,0", "line 4: more than 5 columns");
  refused("1,2,3,4,-0.5", "1,2,inf,4,-0.5", "vx_mm_per_s = 'inf'; required a finite number");
  refused("1,2,3,4,-0.5", "1,2,,4,-0.5", "vx_mm_per_s = ''");
  refused("1,2,3,4,-0.5", "0,2,3,4,-0.5", "the time 0 s is not after that of the row before");
  refused("1,2,3,4,-0.5", "-1,2,3,4,-0.5", "t_s = -1; required");
  refused("0,0,0,5,0", "0,0,1,5,0", "begins at a velocity of (1, 0) mm/s");
  refused("2,4,0,4,0\n", "", "ends at a velocity of (3, -0.5) mm/s");
  refused("t,x,vx,y,vy", "# rows: 4\nt,x,vx,y,vy", "f.csv: 3 rows, but the header says 4");
  refused("t,x,vx,y,vy", "# total_s: 3\nt,x,vx,y,vy", "ends at 2 s, but the header says total_s = 3");
  refused("t,x,vx,y,vy", "# pvt: dwell 0.2.0\nt,x,vx,y,vy", "is missing");
  refused("t,x,vx,y,vy", "# feed in inch/s\nt,x,vx,y,vy", "looks like another unit");
  refused("t,x,vx,y,vy", "# y axis down\nt,x,vx,y,vy", "looks like");
  refused("t,x,vx,y,vy", "# units: t s, x and y mm, vx and vy mm/s\nt,x,vx,y,vy", "second header line of this name");
  refused("t,x,vx,y,vy\n0,0,0,5,0\n1,2,3,4,-0.5\n", "t,x,vx,y,vy,lift\n0,0,0,5,0,1\n1,2,3,4,-0.5,2\n",
          "lift = \"2\"; accepted: 0, 1");
  refused("t,x,vx,y,vy\n0,0,0,5,0\n1,2,3,4,-0.5\n2,4,0,4,0\n",
          "t,x,vx,y,vy,lift\n0,0,0,5,0,1\n1,2,3,4,-0.5,0\n2,4,0,4,0,1\n", "the tool is lifted before this row at");
}

const char* const kTrajectory = "0.5, 1, 2, -0.5, 0.25\n0.5, 1, 0, 0, 0\n";

TEST(XpsTrajectory, IsRelativeAndBeginsWhereItIsSaid) {
  const PvtTable table = parse_xps_trajectory(kTrajectory, "f", Point{10.0, 20.0});
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[1].place, (Point{11.0, 19.5}));
  EXPECT_EQ(table.rows[1].speed, (Point{2.0, 0.25}));
  EXPECT_EQ(table.rows[2].seconds, 1.0);
  expect_contains(input_error([] { parse_xps_trajectory(kTrajectory, "f", {}); }), "required `start` X,Y in mm");
}

TEST(XpsTrajectory, RefusesWhatItWouldMisread) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& says) {
    expect_contains(input_error([&] { parse_xps_trajectory(replaced(kTrajectory, from, to), "f.trj", Point{}); }),
                    says);
  };
  refused("0.5, 1, 2, -0.5, 0.25", "0.5, 1, 2", "f.trj, line 1: 3 columns; required 5: dt, dx, vx, dy, vy");
  refused("0.5, 1, 2, -0.5, 0.25", "0.5, 1, 2, -0.5, 0.25, 0, 0", "line 1: 7 columns");
  refused("0.5, 1, 0, 0, 0", "0, 1, 0, 0, 0", "line 2: dt = 0; required");
  refused("0.5, 1, 0, 0, 0", "-0.5, 1, 0, 0, 0", "line 2: dt = -0.5; required");
  refused("0.5, 1, 0, 0, 0", "0.5, 1, 0.1, 0, 0", "f.trj: the program ends at a velocity of (0.1, 0) mm/s");
  refused("0.5, 1, 0, 0, 0", "0.5, 1, 0, x, 0", "dy = ' x'; required a finite number");
  expect_contains(input_error([] { parse_xps_trajectory("\n", "f.trj", Point{}); }), "no step");
}

TEST(XpsTrajectory, DoesNotDriftFromRoundedPlaces) {
  PvtTable table;
  for (int i = 0; i <= 3000; ++i) {
    const double x = std::round(1e6 * i / 3.0) * 1e-6;
    table.rows.push_back({0.1 * i, {x, -x}, {}, false});
  }
  const PvtTable back = parse_xps_trajectory(xps_trajectory_text(table, 0, 3000), "f", table.rows[0].place);
  EXPECT_NEAR(back.rows.back().place.x, 1000.0, 1e-9);
  EXPECT_NEAR(back.seconds(), 300.0, 1e-9);
}

const char* const kPmac = "; Isx90 = 1000\n; start: X1.5 Y-2\nABS\nPVT250\nX2:1.5 Y-2.5:-0.5\nPVT125.5\nX3:0 Y-3\n";

TEST(PmacProgram, HonoursModesUnitsAndVelocitiesLeftOut) {
  const PvtTable table = parse_pmac_program(kPmac, "f", {});
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].place, (Point{1.5, -2.0}));
  EXPECT_EQ(table.rows[1].place, (Point{2.0, -2.5}));
  EXPECT_EQ(table.rows[1].speed, (Point{1.5, -0.5}));
  EXPECT_EQ(table.rows[2].speed, (Point{0.0, 0.0}));
  EXPECT_DOUBLE_EQ(table.seconds(), 0.3755);
  const PvtTable steps = parse_pmac_program(replaced(kPmac, "ABS", "inc"), "f", {});
  EXPECT_EQ(steps.rows[2].place, (Point{1.5 + 2.0 + 3.0, -2.0 - 2.5 - 3.0}));
  // A velocity counts for Isx90 ms.
  const PvtTable minutes = parse_pmac_program(replaced(kPmac, "; Isx90 = 1000", "I5190=60000"), "f", {});
  EXPECT_DOUBLE_EQ(minutes.rows[1].speed.x, 1.5 / 60.0);
  EXPECT_EQ(parse_pmac_program(replaced(kPmac, "; start: X1.5 Y-2\n", ""), "f", Point{4, 5}).rows[0].place,
            (Point{4, 5}));
}

TEST(PmacProgram, RefusesWhatItWouldMisread) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& says) {
    expect_contains(input_error([&] { parse_pmac_program(replaced(kPmac, from, to), "f.pmc", {}); }), says);
  };
  refused("ABS\n", "", "f.pmc, line 4: a step before ABS or INC");
  refused("PVT250\n", "", "a step before PVT");
  refused("; Isx90 = 1000\n", "", "no Isx90 says for how many ms a velocity counts");
  refused("; start: X1.5 Y-2\n", "", "does not say where it begins; required the comment");
  refused("; start: X1.5 Y-2", "; start: 1.5,-2", "required start: X<mm> Y<mm>");
  refused("PVT250", "PVT0", "PVT = 0; required");
  refused("PVT250", "PVT4096", "PVT = 4096; required");
  refused("PVT250", "PVT250 LINEAR", "line 4: \"LINEAR\" is not known or not honoured; accepted: ABS, INC");
  refused("X2:1.5", "X2:1.5 Z0:0", "\"Z0:0 Y-2.5:-0.5\"");
  refused("X2:1.5 Y-2.5:-0.5", "X2:1.5", "a step without X or Y");
  refused("X2:1.5 Y", "X2:1.5 X", "a second X");
  refused("X2:1.5", "X2:(P1)", "velocity of X = ''");
  refused("X3:0 Y-3", "X3:1 Y-3", "ends at a velocity of (1, 0)");
  refused("ABS", "I5190=1", "Isx90 = 1, but was 1000 before");
  refused("ABS", "; (places in inch)\nABS", "looks like another unit");
  refused("ABS", "; steps: 3\nABS", "f.pmc: 2 steps, but its comment says steps: 3");
  // A number that is cut short would read as another.
  const std::string cut = replaced(replaced(kPmac, "ABS", "; steps: 2\nABS"), "Y-3\n", "Y-3");
  expect_contains(input_error([&] { parse_pmac_program(cut, "f.pmc", {}); }), "the end of the last line");
  expect_contains(input_error([] {
                    parse_pmac_program(kPmac, "f.pmc", Point{0.0, 0.0});
                  }),
                  "start is X1.500000 Y-2.000000, but was said to be X0.000000 Y0.000000");
}

TEST(PmacProgram, CutsStepsThatAreTooLongOnTheSameCubic) {
  PvtTable table;
  table.rows = {{0.0, {0.0, 1.0}, {}, true}, {10.0, {20.0, -5.0}, {3.0, 0.5}, false}, {12.0, {22.0, -5.0}, {}, false}};
  const std::string text = pmac_program_text(table, 0, 2, made_by());
  const PvtTable back = parse_pmac_program(text, "f", {});
  ASSERT_EQ(back.rows.size(), 5U);
  EXPECT_NEAR(back.seconds(), 12.0, 1e-8);
  // Hermite's own basis at a third of the step.
  const double s = back.rows[1].seconds / 10.0, h = s * s * (3 - 2 * s), v1 = 10.0 * s * s * (s - 1);
  EXPECT_NEAR(back.rows[1].place.x, 20.0 * h + 3.0 * v1, 1e-6);
  EXPECT_NEAR(back.rows[1].place.y, 1.0 - 6.0 * h + 0.5 * v1, 1e-6);
  EXPECT_NEAR(back.rows[1].speed.x, (20.0 * 6 * s * (1 - s) + 3.0 * 10.0 * (3 * s * s - 2 * s)) / 10.0, 1e-6);
}

TEST(PvtJson, RefusesWhatItWouldMisread) {
  PvtTable table;
  table.rows = {{0.0, {-1.0, 2.0}, {}, true}, {0.5, {0.0, 2.0}, {2.0, -0.25}, false}, {1.25, {1.5, 2.0}, {}, false}};
  const std::string text = pvt_json_text(table, made_by());
  EXPECT_EQ(parse_pvt_json(text, "f").rows[1].speed, (Point{2.0, -0.25}));
  const auto refused = [&text](const std::string& from, const std::string& to, const std::string& says) {
    expect_contains(input_error([&] { parse_pvt_json(replaced(text, from, to), "f.json"); }), says);
  };
  refused("x and y mm", "x and y um", "f.json: units = \"t s, x and y um, vx and vy mm/s\"; accepted");
  refused("\"x_mm\", \"vx_mm_per_s\"", "\"vx_mm_per_s\", \"x_mm\"", "columns = a list of 6; accepted: [");
  refused("\"total_s\"", "\"scale\"", "key 'scale' is not known");
  refused("\"rows\": [", "\"rows\": [7,", "f.json, row 1: 7; required a list of 6 numbers");
  refused("2.000000, -0.250000, 0]", "2.000000, -0.250000]", "row 2: a list of 5; required a list of 6 numbers");
  refused("\"total_s\"", "\"rows\": [], \"total_s\"", "a second 'rows'; accepted: one");
  refused("2.000000, -0.250000, 0]", "2.000000, null, 0]", "vy_mm_per_s = null; required a number");
  refused("\"total_s\": 1.25", "\"total_s\": 2.25", "total_s = 2.25, but the rows end at 1.25 s");
  refused("[1.250000000", "[0.500000000", "is not after that of the row before");
  refused("\n]\n}\n", "\n", "is no JSON object");
}

TEST(PvtHdf5, RefusesWhatItWouldMisread) {
  PvtTable table;
  table.rows = {{0.0, {-1.0, 2.0}, {}, true}, {0.5, {0.0, 2.0}, {2.0, -0.25}, false}, {1.25, {1.5, 2.0}, {}, false}};
  const std::string bytes = pvt_hdf5_bytes(table, made_by());
  const PvtTable back = parse_pvt_hdf5(bytes, "f.h5");
  ASSERT_EQ(back.rows.size(), 3U);
  EXPECT_EQ(back.rows[1].speed, (Point{2.0, -0.25}));
  EXPECT_TRUE(back.rows[0].lifted);
  expect_contains(input_error([&] { parse_pvt_hdf5(replaced(bytes, "x and y mm", "x and y um"), "f.h5"); }),
                  "f.h5: the attribute units of HDF5 data set '/pvt' is another; accepted: t s, x and y mm");
  expect_contains(input_error([&] { parse_pvt_hdf5(replaced(bytes, "vy_mm_per_s", "ay_mm_per_s"), "f.h5"); }),
                  "the attribute columns");
  expect_contains(input_error([&] { parse_pvt_hdf5(bytes.substr(0, bytes.size() / 2), "f.h5"); }), "f.h5");
  table.rows.back().speed.x = 1.0;
  expect_contains(input_error([&] { parse_pvt_hdf5(pvt_hdf5_bytes(table, made_by()), "f.h5"); }), "ends at a velocity");
}

TEST(StretchList, RefusesFilesThatAreNotTheOnesItWasMadeWith) {
  const test::TemporaryFolder folder;
  through_files("xps-trj", lifted_motion(), folder);
  const auto list = folder.path() / "xps.csv";
  const std::string text = read_whole_file(list);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& says) {
    folder.file("xps.csv", replaced(text, from, to));
    expect_contains(input_error([&] { read_program(list); }), says);
  };
  refused("program_002.trj", "../program_002.trj", "required the name of a file beside this one");
  refused("program_002.trj", "program_001.trj", "required the file that the list was made with");
  refused("# stretches: 3", "# stretches: 4", "3 stretches, but the header says 4");
  refused("x and y of the beginning mm", "x and y of the beginning in", "units = ");
  refused("way_s", "way", "column line");
  refused("program_002.trj", "program_009.trj", "program_009.trj");
  folder.file("xps.csv", text);
  folder.file("program_001.trj", "1, 1, 0, 0, 0\n");
  expect_contains(input_error([&] { read_program(list); }), "required the file that the list was made with");
}

}  // namespace
}  // namespace dwell
