#include <gtest/gtest.h>

#include <algorithm>

#include "runs/programs/gcode_reader.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;

Program read_program_of(const std::string& text) { return read_gcode(text, "part.nc", {}); }

// Line 1 to 3: at (0, 0), at work.
const std::string kBeginning = "G21 G90 G94 G0 Z5\nG0 X0 Y0\nG1 Z0 F600\n";

TEST(GcodeRemarks, RefusesACommentThatNamesOtherAxes) {
  for (const std::string comment :
       {"(X AND Y SWAPPED)", "(AXES ROTATED 90)", "(COORDINATES ROTATED BY 90 DEG)", "(MIRRORED IN X)", "(Y INVERTED)",
        "; y axis down", "(X TO THE LEFT)", "(SWAP X AND Y)", "(X IS Y)", "(COORDINATE ROTATION 90)",
        "(PROGRAM MIRRORED)", "(COORDINATES IN PIXELS)", "(XY SCALED 2)"}) {
    const std::string message = input_error([&] { read_program_of(kBeginning + comment + "\nG1 X1\nM2\n"); });
    expect_contains(message, "part.nc, line 4: the comment \"");
    expect_contains(message, "accepted: X, Y as those of the map in mm");
  }
}

TEST(GcodeRemarks, LetsTheProseOfMachineShopsPass) {
  for (const std::string comment : {"(OP2 - FLIP PART)",
                                    "(ROTATE PART 180 DEG FOR SECOND SIDE)",
                                    "(SPINDLE REVERSED)",
                                    "(COOLANT TURNED ON)",
                                    "(T1 D=6. CR=0. - ZMIN=-2.5 - FLAT END MILL)",
                                    "(STOCK TOP X0 Y0 Z0)",
                                    "(WCS ORIGIN: TOP LEFT CORNER)",
                                    "(X+ TO THE RIGHT, Y+ UP)",
                                    "(FACE MILL 50 MM)",
                                    "(A AXIS ROTATED 90)",
                                    "(B-AXIS ROTATION 45)",
                                    "(TURNED DIA 40)",
                                    "(ROUGHING PASS 2 OF 3)",
                                    "(MACHINE: HAAS VF-2)",
                                    "(POST PROCESSOR: FANUC 18I)",
                                    "(CHECK Z CLEARANCE)",
                                    "(MAX Y 50)",
                                    "(RETURN TO HOME)",
                                    "(ROTATED 0)",
                                    "(AXES NOT SWAPPED)",
                                    "(MIRROR M1, SURFACE 2)",
                                    "(PECK DRILL 4 X 3.3)",
                                    "(VENDOR: SANDVIK)",
                                    "(DATE 2026-03-04 TIME 12:30)",
                                    "(LEFT SIDE, TOOL DOWN)",
                                    "(FEED 600 SPEED 1200)",
                                    "(ABSOLUTE COORDINATES)",
                                    "(G54 = CENTRE OF VICE)"}) {
    const auto steps = [&] { return read_program_of(kBeginning + comment + "\nG1 X1\nM2\n").steps.size(); };
    EXPECT_NO_THROW(EXPECT_EQ(steps(), 2u)) << comment;
  }
}

TEST(GcodeWorkOffset, IsTakenBeforeTheToolIsBroughtAnywhere) {
  const std::string rest = "G0 X0 Y0\nG1 Z0 F60\nX1\nM2\n";
  for (const std::string start : {"G0 Z10\nG55\n", "G54\nG55\nG0 Z10\n", "G54\nG0 Z10\nG55\n"}) {
    const Program program = read_program_of(start + rest);
    EXPECT_EQ(program.steps.size(), 2u) << start;
    EXPECT_TRUE(std::any_of(program.notes.begin(), program.notes.end(),
                            [](const std::string& note) { return note.starts_with("G55: the offset"); }));
  }
  for (const std::string start : {"G0 Z10\nG0 X0 Y0\nG55\n", "G0 Z0\nG55\n", "G54\nG0 X0 Y0\nG55\n"}) {
    expect_contains(input_error([&] { read_program_of(start + rest); }), "G55 after moves with G54");
  }
}

}  // namespace
}  // namespace dwell
