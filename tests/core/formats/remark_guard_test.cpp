#include "core/formats/remark_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace dwell {
namespace {

using About = UnclearStatement::About;

bool suspects(const std::string& remark, About about) {
  const auto unclear = unclear_remarks(remark, "map a.csv, line 2");
  return std::any_of(unclear.begin(), unclear.end(), [&](const UnclearStatement& s) { return s.about == about; });
}

void expect_all(About about, std::initializer_list<const char*> remarks) {
  for (const char* remark : remarks) EXPECT_TRUE(suspects(remark, about)) << remark;
}

TEST(RemarkGuard, LetsProsePass) {
  for (const char* remark : {"measured by Anna, 20 C",
                             "5 mm aperture stop",
                             "wavelength: 632.8 nm",
                             "wavelength [nm]: 632.8",
                             "instrument: Verifire",
                             "instrument: Zygo Verifire, 633 nm",
                             "date: 2024-05-06 12:30",
                             "PV: 120.3 nm",
                             "RMS 23 nm",
                             "Channel: Fig",
                             "rms [nm] = 12.3",
                             "PV (nm): 120",
                             "peak-to-valley in nm: 33",
                             "Ra = 0.5 nm",
                             "tool: 5 mm wheel",
                             "aperture [mm]",
                             "diameter in mm: 90",
                             "Zernike fit removed: piston, tilt, power",
                             "mirror M2, side A",
                             "measured with a 4 inch transmission sphere",
                             "average of 16 maps",
                             "f/7.2 sphere, radius 2000 mm",
                             "height map of mirror M1",
                             "columns: x; rows: y",
                             "rows: row 1 = smallest y; columns: column 1 = smallest x",
                             "created by Python 3.11",
                             "temperature in degrees",
                             "masked by hand",
                             "12 bad pixels",
                             "no data outside the aperture",
                             "exposure time: 5 ms",
                             "Dr. M. Meier, Jena",
                             "unit under test: mirror 3",
                             "surface figure error of the part",
                             "top surface of the window",
                             "measured at 3 pm",
                             "RMS wavefront error below lambda/20",
                             "1/20 wave PV",
                             "fringe projection",
                             "interferogram with 5 fringes",
                             "noise of a few nm",
                             "file: C:/data/mirror_m1/height.txt",
                             "x: to the right, y: up",
                             "cleaned in the clean room",
                             "data taken in May",
                             "slurry: cerium oxide, 1 um",
                             "pitch: Gugolz 64",
                             "lateral resolution (optical): 3 um",
                             "scale: 1",
                             "removal of 20 nm planned",
                             "phase shift 90 deg",
                             "rotated by 0 deg",
                             "mirror rotated to 0 deg",
                             "lens f = 100 mm x 2",
                             "rows = y, columns = x",
                             "rows along x",
                             "axis 0 = y, axis 1 = x",
                             "row-major",
                             "viewed from the front",
                             "origin: lower left",
                             "positive: material to remove",
                             "positive is up",
                             "not normalised",
                             "10x objective",
                             "array is [y, x]",
                             "columns [x, y, z]",
                             "centre [x, y] of the part",
                             "z[iy][ix]",
                             "image size (x, y)",
                             "data points (x, y)",
                             "camera frame 12",
                             "display system: X11",
                             "image of the part",
                             "2 x 3 array of parts",
                             "9 rows x 12 columns",
                             "1 in = 25.4 mm",
                             "lambda/20",
                             "M1 figure, nm RMS 3.4",
                             "x from 0 to 5.5 mm, y from 0 to 4 mm",
                             "x 0.5 mm",
                             "background subtracted",
                             "outside temperature: 9 C",
                             "sign of wear: none",
                             "back side polished",
                             "FITS (Flexible Image Transport System) format is defined in 'Astronomy",
                             "and Astrophysics', volume 376, page 359; bibcode: 2001A&A...376..359H",
                             "",
                             ":",
                             "=,;|()[]"}) {
    const auto unclear = unclear_remarks(remark, "map a.csv");
    EXPECT_TRUE(unclear.empty()) << remark << " -> " << unclear.front().message;
  }
}

TEST(RemarkGuard, FindsAUnitThatBelongsToNoNumber) {
  expect_all(About::Unit, {"amplitude in um", "residual, microns", "all lengths in m", "mesh in \xc2\xb5m",
                           "Scan 7, um", "dz [um]", "values z_um", "z/um", "measured (nm)", "TIF [um/s]",
                           "Messwerte [\xc2\xb5m]", "RMS surface error in nm", "unknown: um"});
}

TEST(RemarkGuard, FindsWaves) {
  expect_all(About::Unit, {"OPD in waves at 633 nm", "values in lambda", "wavefront [waves]", "heights in fringes",
                           "tilt, phase in radians", "raw, in counts"});
}

TEST(RemarkGuard, FindsAFactor) {
  expect_all(About::Factor, {"height [10 nm]",
                             "height / 10 nm",
                             "sag (x 10 nm)",
                             "nm/count: 0.5",
                             "0.5 nm per digit",
                             "3 counts per nm",
                             "gain of 2.5",
                             "values x 1e-3 mm",
                             "values \xc3\x97 1000",
                             "data *1000",
                             "heights times 10",
                             "scaled by 0.5",
                             "heights in 10^-9 m",
                             "surface [1e-9 m]",
                             "data in units of 0.1 nm",
                             "interferometric scale factor 0.5",
                             "mit Faktor 2 multipliziert",
                             "1 count = 0.1 nm",
                             "1 LSB -> 0.25 nm",
                             "counts to nm: 0.25",
                             "height = 0.5 * value",
                             "value*0.5",
                             "z/1000",
                             "nm*10",
                             "10 x nm",
                             "*1000",
                             "x1000",
                             "1e-6 m",
                             "10^-6 m",
                             "0.1 nm",
                             "normalised",
                             "normalized to the peak",
                             "arbitrary units",
                             "factor two",
                             "x 10^-6",
                             "values in %",
                             "micro",
                             "x 1e-6 m",
                             "e-6 m",
                             "x e-6 m",
                             "* 1e-9 m",
                             "divisor 1000"});
}

TEST(RemarkGuard, FindsASignOfTheValues) {
  expect_all(About::Factor, {"heights negated", "sign: -1", "bumps are negative", "positive = hole",
                             "positive is into the glass", "negative is up"});
}

TEST(RemarkGuard, FindsPlacesInAnotherUnit) {
  expect_all(About::Places,
             {"pixel indices", "1 px = 0.1 mm", "0.1 mm per pixel", "0.1 mm/pixel", "x and y in pixels",
              "coordinates are in inches", "all lengths in m", "lateral positions in um, heights in nm"});
  EXPECT_FALSE(suspects("coordinates in mm", About::Places));
}

TEST(RemarkGuard, FindsAnOrientation) {
  expect_all(About::Rows,
             {"row 0 = top", "origin: upper left", "rows run down", "row 1 = largest y", "erste Zeile oben",
              "rows = x, columns = y", "columns: y", "first index is x", "x is the row index", "axis 0 = x",
              "rows along y", "Fortran order", "column-major", "array is [x, y]", "indexed z[ix][iy]",
              "data stored as (x, y)", "index order x, y", "shape (nx, ny)", "array is [column, row]"});
  expect_all(About::Axes, {"image flipped", "y axis points downwards", "y down", "upside down", "rotated by 90 deg",
                           "gespiegelt", "viewed from the back", "seen through the substrate", "rear view",
                           "mirror image", "x to the left", "x axis points left", "left-handed", "rot90",
                           "image coordinates", "screen convention", "seen from below"});
}

TEST(RemarkGuard, FindsAPlaceOfTheMap) {
  expect_all(About::Origin, {"centre at 50, 50", "origin: center", "extent 0 100 0 80", "Mitte bei 12,5",
                             "x from -25 to 25 mm", "x: -25 to 25", "x = -25:0.5:25", "-25 < x < 25", "y in [-25, 25]",
                             "starts at x = -25 mm", "left edge at x=-25 mm", "origin at pixel (6,5)"});
  expect_all(About::Shift, {"shifted by 3 mm", "x offset 10", "offset: x=10, y=5 mm"});
  EXPECT_FALSE(suspects("centre of the mirror", About::Origin));
}

TEST(RemarkGuard, FindsAMarkerOfNoData) {
  expect_all(About::NoData, {"missing pixels set to -9999", "-1 = no data", "bad pixels are 0", "outside the part: 9",
                             "padded with 9", "dead pixels set to 9", "background is 9"});
}

TEST(RemarkGuard, SaysWhatWouldBeClearWhereTheRemarkStands) {
  const auto comment = unclear_remarks("amplitude in um", "map a.csv, line 2");
  ASSERT_EQ(comment.size(), 1u);
  EXPECT_EQ(
      comment[0].message,
      "map a.csv, line 2: 'amplitude in um' looks like the unit of the values; write '# unit: um', or the comment "
      "without a unit");
  const auto field = unclear_remarks("amplitude in um", "map a.h5: note", RemarkPlace::Field);
  ASSERT_EQ(field.size(), 1u);
  EXPECT_NE(field[0].message.find("under a name of its own"), std::string::npos) << field[0].message;
}

}  // namespace
}  // namespace dwell
