#include "core/formats/text_header.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "core/map/value_units.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

/// Of a matrix of 3 rows and 4 columns.
MapHeader header_of(const std::string& lines) {
  TextHeader header("map a.csv");
  long number = 0;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    header.read_comment(lines.substr(begin, end - begin), ++number);
    begin = end + 1;
  }
  return header.header_of_matrix(3, 4);
}

bool says_nothing(const MapHeader& h) {
  return !h.unit && !h.pitch && !h.origin && h.no_data.empty() && h.unclear.empty() && h.history.empty();
}

/// Whether something about this is unclear, and the message says the line and all of the words.
void expect_unclear(const std::string& line, About about, std::initializer_list<std::string> words) {
  const MapHeader header = header_of("# first\n" + line);
  ASSERT_EQ(header.unclear.size(), 1u) << line;
  EXPECT_EQ(header.unclear[0].about, about) << line;
  for (const std::string& word : words) {
    EXPECT_NE(header.unclear[0].message.find(word), std::string::npos) << word << " in " << header.unclear[0].message;
  }
}

TEST(TextHeader, TakesTheUnitOfTheValuesInEverySpelling) {
  for (const char* line : {"# unit: um",
                           "# Unit: um",
                           "# UNITS = um",
                           "# units um",
                           "#unit=um",
                           "## unit :um",
                           "# height unit: micron",
                           "# Height_Units: [um]",
                           "# Value units: \xc2\xb5m",
                           "# z unit: \xce\xbcm",
                           "# zunit: um",
                           "# unit (um)",
                           "# data unit: micrometres",
                           "# units of heights: um",
                           "# unit of z: um",
                           "# heights in um",
                           "# All heights are given in microns",
                           "# Height [um]",
                           "# z: um",
                           "# z (um)",
                           "# Height: um",
                           "# Surface error: um",
                           "# Tuesday, units: um",
                           "# note: heights in um",
                           "# x: right; unit: um",
                           "# \"unit: um\"",
                           "# surface_unit: Micrometer"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit.has_value()) << line;
    EXPECT_EQ(unit_factor(*header.unit, MapQuantity::Height), 1e3) << line;
    EXPECT_TRUE(header.unclear.empty()) << line << ": " << header.unclear[0].message;
  }
  EXPECT_EQ(unit_factor(*header_of("# rate unit: um/min").unit, MapQuantity::Rate), 1e3 / 60.0);
}

TEST(TextHeader, KnowsGermanAndFrench) {
  for (const char* line :
       {"# Einheiten: um", "# Einheit: \xc2\xb5m", "# unit\xc3\xa9: um", "# unit\xe9s = um",
        "# H\xc3\xb6he in Mikrometer", "# H\xf6hen [um]",
        "# Ma\xc3\x9f"
        "einheit: um",
        "# hauteurs en microm\xc3\xa8tres", "# residual, microns", "# amplitude in um", "# unit,um,"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit) << line;
    EXPECT_EQ(known_length_unit(*header.unit), 1e3) << line;
    EXPECT_TRUE(header.unclear.empty()) << line << ": " << header.unclear[0].message;
  }
  for (const char* line : {"# Pixelabstand: 0.25 mm", "# pas: 250 um", "# Schrittweite_mm: 0.25",
                           "# Pixelgr\xc3\xb6\xc3\x9f"
                           "e: 0.25 mm",
                           "# pitch_mm,0.25"}) {
    EXPECT_EQ(header_of(line).pitch, (Point{0.25, 0.25})) << line;
  }
  EXPECT_EQ(header_of("# Ursprung_mm: 100,-50").origin, (Point{100.0, -50.0}));
  EXPECT_EQ(header_of("# Fehlwert: -9999").no_data, std::vector<double>{-9999.0});
  expect_unclear("# Breite: 100 mm", About::Pitch, {"Breite", "100 mm"});
  expect_unclear("# pas: 0.5", About::Pitch, {"pas", "'0.5'", "without a unit"});
  expect_unclear("# Verst\xc3\xa4rkung: 2.5", About::Factor, {"'2.5'", "factor"});
}

TEST(TextHeader, KnowsWordsOfOtherLanguages) {
  for (const char* line :
       {"# unidad: micras", "# unidades: um", "# unit\xc3\xa0: micrometri", "# altura en micras", "# altezza [um]",
        "# eenheid: um", "# \xd0\x95\xd0\xb4\xd0\xb8\xd0\xbd\xd0\xb8\xd1\x86\xd1\x8b: \xd0\xbc\xd0\xba\xd0\xbc",
        "# \xe5\x8d\x95\xe4\xbd\x8d: \xe5\xbe\xae\xe7\xb1\xb3", "# \xe5\x8d\x98\xe4\xbd\x8d\xef\xbc\x9a\xc2\xb5m",
        "# \xe9\xab\x98\xe3\x81\x95 [um]", "# \xe5\xbe\xae\xe7\xb1\xb3"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit) << line;
    EXPECT_EQ(known_length_unit(*header.unit), 1e3) << line;
  }
  test::expect_input_error([] { header_of("# unidad: codos"); }, {"line 1", "unidad = 'codos'", "nm, um"});
}

TEST(TextHeader, TakesAUnitThatIsNamedTwiceOrParted) {
  for (const char* line : {"# Units = micrometre (um)", "# Units: um [microns]", "# UNIT\tum"}) {
    ASSERT_TRUE(header_of(line).unit) << line;
    EXPECT_EQ(known_length_unit(*header_of(line).unit), 1e3) << line;
  }
  const MapHeader both = header_of("# unit\tum\tpitch_mm\t0.5\tby Anna");
  EXPECT_EQ(both.unit, "um");
  EXPECT_EQ(both.pitch, (Point{0.5, 0.5}));
  test::expect_input_error([] { header_of("# Units = micrometre (nm)"); }, {"'micrometre (nm)'"});
}

TEST(TextHeader, AsksWhichWayTheMapLiesAndWhatItsNumbersAre) {
  for (const char* line :
       {"# orientation = 3", "# rotation: 90 deg", "# clocking: 45 deg", "# view: back", "# y axis: down",
        "# transposed: yes", "# y_up: false", "# y down: yes", "# x axis left = true", "# angle: 15 deg",
        "# angle_deg: 15", "# image coordinates", "# seen from below"}) {
    expect_unclear(line, About::Axes, {"line 2", "orientation"});
  }
  for (const char* line : {"# order: F", "# dims: x, y", "# index order: x, y", "# columns: y", "# array is [x, y]"}) {
    expect_unclear(line, About::Rows, {"line 2", "orientation"});
  }
  for (const char* line :
       {"# exponent: -6", "# prefix: micro", "# sign: -1", "# power of ten: -6", "# divisor: 1000",
        "# counts to nm: 0.25", "# normalised: yes", "# magnitude: -6", "# z_up: no", "# x 1e-6 m", "# e-6 m"}) {
    expect_unclear(line, About::Factor, {"line 2", "values"});
  }
  for (const char* line : {"# mask: 9", "# background 9", "# outside: 9", "# Hintergrund: 9"}) {
    expect_unclear(line, About::NoData, {"line 2", "no data"});
  }
  const MapHeader step = header_of("# height: 10 nm");
  ASSERT_FALSE(step.unclear.empty());
  EXPECT_EQ(step.unclear[0].about, About::Factor) << "a step of the values, or a field?";
  expect_unclear("# xmin=-25", About::Origin, {"xmin", "origin_mm"});
  expect_unclear("# x range: -25 25", About::Origin, {"x range", "origin_mm"});
  expect_unclear("# reference pixel: 5, 6", About::Origin, {"reference pixel"});
  for (const char* line : {"# orientation: none",  "# row order: bottom-up",
                           "# rotation: 0",        "# flip: no",
                           "# order: C",           "# dims: y, x",
                           "# sign: +1",           "# prefix: run7_",
                           "# mask: 3 mm",         "# outside diameter: 100 mm",
                           "# x range: 0 5.5",     "# origin: lower",
                           "# origin: lower left", "# rows: y; columns: x",
                           "# y_up: true",         "# y down: no",
                           "# z_up: yes",          "# angle: 0",
                           "# columns: x",         "# array is [y, x]"}) {
    const MapHeader header = header_of(line);
    EXPECT_TRUE(says_nothing(header)) << line << (header.unclear.empty() ? "" : ": " + header.unclear[0].message);
  }
}

TEST(TextHeader, AsksWhatADecimalCommaMeans) {
  for (const char* line : {"# Pixelabstand: 0,5 mm", "# pitch: 1,5 mm", "# dx: 0,5 mm", "# pas = 0,5"}) {
    expect_unclear(line, About::Pitch, {"decimal comma"});
  }
  EXPECT_EQ(header_of("# pitch_mm: 1,2").pitch, (Point{1.0, 2.0})) << "as this program writes it";
  EXPECT_EQ(header_of("# pitch: 0.25, 0.5 mm").pitch, (Point{0.25, 0.5}));
}

TEST(TextHeader, TakesAUnitThatStandsAlone) {
  for (const char* line : {"# um", "# [um]", "#microns", "# (\xc2\xb5m)"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit) << line;
    EXPECT_EQ(known_length_unit(*header.unit), 1e3) << line;
  }
  EXPECT_EQ(header_of("# um/s").unit, "um/s");
  for (const char* line : {"# waves", "# lambda", "# [fringes]"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit) << line;
    EXPECT_TRUE(is_wave_unit(*header.unit)) << line;
  }
  test::expect_input_error([&] { header_of("# [mrad]"); }, {"line 1", "a unit of height"});
}

TEST(TextHeader, FindsAUnitInBracketsBehindAnyWords) {
  for (const char* line : {"# measured through the window of the long chamber (nm)", "# dz [um]", "# TIF [um/s]",
                           "# slope [urad]", "# sag of run 7 [m]"}) {
    expect_unclear(line, About::Unit, {"line 2", "unit of the values"});
  }
  EXPECT_TRUE(says_nothing(header_of("# aperture [mm]")));
}

TEST(TextHeader, TakesThePitchInEveryUnit) {
  for (const char* line : {"# pitch_mm: 0.25",
                           "# Pitch_MM = 0.25",
                           "# pitch_um: 250",
                           "# pitch: 250 um",
                           "# pitch = 0.25mm",
                           "# Pixel size: 0.25 mm",
                           "# PixelSize [um]: 250",
                           "# pixel_size_um=250",
                           "# Pixel size (x,y): 0.25 mm",
                           "# pixel pitch 0.25 mm",
                           "# the pitch is 0.25 mm",
                           "# Lateral resolution: 2.5e-4 m",
                           "# pixel spacing: 250 \xc2\xb5m",
                           "# pixel scale: 0.25 mm/pixel",
                           "# mm/pixel: 0.25",
                           "# mm per px = 0.25",
                           "# sampling: 0.25 mm",
                           "# dx: 0.25 mm; dy: 0.25 mm",
                           "# dx = 250 um, dy = 0.25 mm",
                           "# Camera Res: 0.00025 m",
                           "# pitch: 0.25 x 0.25 mm",
                           "# pitch_mm: [0.25, 0.25]",
                           "# x pixel size: 0.25 mm, y pixel size: 0.25 mm",
                           "# xscale: 0.25 mm; yscale: 0.25 mm"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.pitch.has_value()) << line;
    EXPECT_DOUBLE_EQ(header.pitch->x, 0.25) << line;
    EXPECT_DOUBLE_EQ(header.pitch->y, 0.25) << line;
  }
  EXPECT_EQ(header_of("# pitch: 0.25 \xc3\x97 0.5 mm").pitch, (Point{0.25, 0.5}));
  EXPECT_EQ(header_of("# pitch_mm: 0.1,0.3").pitch, (Point{0.1, 0.3}));
  EXPECT_EQ(header_of("# pitch_mm: 0.1; 0.3; note").pitch, (Point{0.1, 0.3}));
  EXPECT_EQ(header_of("# dy_mm: 0.5\n# dx_mm: 0.25").pitch, (Point{0.25, 0.5}));
}

TEST(TextHeader, TakesTheSizeThatGwyddionWrites) {
  // Four columns and three rows: the size is that of all pixels, edge to edge.
  const MapHeader header = header_of("# Channel: Fig\n# Width: 12.000 mm\n# Height: 9.600 mm\n# Value units: m");
  EXPECT_DOUBLE_EQ(header.pitch->x, 3.0);
  EXPECT_DOUBLE_EQ(header.pitch->y, 3.2);
  EXPECT_EQ(header.unit, "m");
  EXPECT_NEAR(header.pitch_rounding, 0.0005 / 9.6, 1e-12);
  test::expect_input_error([] { header_of("# Channel: F\n# Width: 12 mm\n# Height: 9 mm\n# pitch_mm: 2"); },
                           {"map a.csv", "Width", "3 x 3 mm", "2 x 2 mm", "agree"});
  // Of another program it may be from the first pixel to the last.
  expect_unclear("# width: 12 mm", About::Pitch, {"width", "12 mm", "pitch_mm"});
  expect_unclear("# size: 12 x 9", About::Pitch, {"line 2", "size", "'12 x 9'"});
  EXPECT_TRUE(says_nothing(header_of("# size: 3 x 4")));
  EXPECT_TRUE(says_nothing(header_of("# Width: 4\n# Height: 3")));
  EXPECT_TRUE(says_nothing(header_of("# Size: 640 x 480 pixels")));
}

TEST(TextHeader, TakesTheOriginAndRefusesAnOffset) {
  for (const char* line : {"# origin_mm: 100,-50", "# Origin_mm: 100, -50", "# origin = 100 x -50 mm",
                           "# Origin [um]: 100000,-50000", "# x0_mm: 100; y0_mm: -50", "# xmin: 100 mm, ymin: -5 cm"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.origin.has_value()) << line;
    EXPECT_DOUBLE_EQ(header.origin->x, 100.0) << line;
    EXPECT_DOUBLE_EQ(header.origin->y, -50.0) << line;
  }
  expect_unclear("# origin: 100,50", About::Origin, {"line 2", "origin", "'100,50'", "origin_mm"});
  expect_unclear("# offset: 3 mm", About::Shift, {"line 2", "offset", "'3 mm'", "origin_mm"});
  expect_unclear("# X_Offset_mm: 3", About::Shift, {"X_Offset_mm", "'3'"});
  expect_unclear("# x0: 3 mm", About::Origin, {"x0", "one direction"});
  for (const char* line :
       {"# center_mm: 50,50", "# centre: 0, 0", "# extent: 0 100 0 80", "# origin: center", "# corner: 0,0",
        "# lower left: 3, 4 mm", "# Bildmitte: 50 50 mm", "# map centre at 12, 9 mm"}) {
    expect_unclear(line, About::Origin, {"origin_mm", "centre of the first pixel"});
  }
  EXPECT_TRUE(says_nothing(header_of("# offset: 0,0\n# origin: Oslo\n# z offset: 0")));
}

TEST(TextHeader, TakesTheValueForNoData) {
  for (const char* line : {"# nodata: -9999", "# NoData_value = -9999", "# NODATA -9999", "# no data: -9999",
                           "# missing value: -9999", "# _FillValue: -9999", "# Bad data value = -9999"}) {
    EXPECT_EQ(header_of(line).no_data, std::vector<double>{-9999.0}) << line;
  }
  EXPECT_EQ(header_of("# nodata: -9999, 32767").no_data, (std::vector<double>{-9999.0, 32767.0}));
  EXPECT_TRUE(says_nothing(header_of("# nodata: nan\n# no data: none\n# bad pixels: 17\n# mask: 3 mm")));
  expect_unclear("# missing: -9999", About::NoData, {"missing", "-9999", "nodata"});
}

TEST(TextHeader, TakesWavesForAUnitAndKnowsTheirLength) {
  for (const char* line : {"# Unit: waves", "# heights in fringes", "# z [waves]", "# heights in \xce\xbb",
                           "# Einheit: Wellenl\xc3\xa4ngen"}) {
    const MapHeader header = header_of(line);
    ASSERT_TRUE(header.unit) << line;
    EXPECT_TRUE(is_wave_unit(*header.unit)) << line;
    EXPECT_TRUE(header.unclear.empty()) << line;
  }
  for (const char* line : {"# wavelength: 632.8 nm", "# Wavelength [nm]: 632.8", "# laser wavelength = 0.6328 um",
                           "# Wellenl\xc3\xa4nge: 632.8 nm"}) {
    ASSERT_TRUE(header_of(line).wavelength) << line;
    EXPECT_NEAR(*header_of(line).wavelength, 632.8, 1e-9) << line;
  }
  for (const char* line : {"# wavelength: 632.8", "# wavelength: 5 mm", "# wavelengths: 633, 532 nm",
                           "# wavelength: 633 nm\n# second wavelength: 532 nm"}) {
    EXPECT_FALSE(header_of(line).wavelength) << line;
  }
}

TEST(TextHeader, QuestionsPathDifferences) {
  for (const char* line : {"# OPD", "# OPD [nm]", "# quantity: wavefront", "# WFE map in nm", "# Wellenfrontfehler",
                           "# wavefront error, transmitted", "# front d'onde"}) {
    const MapHeader header = header_of(line);
    ASSERT_FALSE(header.unclear.empty()) << line;
    EXPECT_EQ(header.unclear.front().about, About::Wavefront) << line;
    EXPECT_NE(header.unclear.front().message.find("line 1"), std::string::npos) << header.unclear.front().message;
  }
  EXPECT_TRUE(header_of("# surface of the opdrachtgever").unclear.empty());
  EXPECT_TRUE(header_of("# made: wave scale 0.5: the values were an OPD").unclear.empty()) << "history";
}

TEST(TextHeader, KeepsWhatIsUnclearForWhoeverKnowsTheOptions) {
  expect_unclear("# pitch: 0.25", About::Pitch, {"map a.csv, line 2", "pitch", "'0.25'", "without a unit", "pitch_mm"});
  expect_unclear("# resolution: 0.1 mm", About::Pitch, {"resolution"});
  expect_unclear("# the pixel pitch was found to be 0.25 mm", About::Pitch, {"pitch_mm"});
  expect_unclear("# z scale: 1e-9", About::Factor, {"z scale", "'1e-9'", "unit"});
  expect_unclear("# gain: 2.5", About::Factor, {"gain", "'2.5'", "factor"});
  expect_unclear("# height [10 nm]", About::Factor, {"factor"});
  expect_unclear("# nm/count: 0.5", About::Factor, {"factor"});
  expect_unclear("# laser unit: um", About::Unit, {"laser unit um"});
  expect_unclear("# values in waves at 633 nm", About::Unit, {"no length"});
  expect_unclear("# row 0 = top", About::Rows, {"orientation"});
  expect_unclear("# dz: 2 nm", About::Factor, {"dz", "unit"});
  expect_unclear("# measured height map of Tuesday (um)", About::Unit, {"looks like the unit", "# unit: um"});
  expect_unclear("# unit um of the surface", About::Unit, {"unit um of"});
  expect_unclear("# lateral unit: um", About::Pitch, {"lateral unit"});
  expect_unclear("# pitch: unknown", About::Pitch, {"pitch", "'unknown'", "mm or with a unit"});
  expect_unclear("# dx: 0.5 mm", About::Pitch, {"dx", "one direction"});
}

TEST(TextHeader, RefusesByNameWhatItCannotRead) {
  const auto refused = [](const std::string& line, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { header_of("# first\n" + line); }, {"map a.csv, line 2"});
    test::expect_input_error([&] { header_of("# first\n" + line); }, words);
  };
  refused("# Unit: radians", {"Unit", "'radians'", "nm, um, mm, m, waves"});
  refused("# heights in counts", {"'counts'", "nm, um"});
  refused("# z [rad]", {"'rad'", "nm, um"});
  test::expect_input_error([&] { header_of("# z unit: nm\n# Unit: waves"); }, {"line 2", "'waves'", "'nm'", "agree"});
  test::expect_input_error([&] { header_of("# z [waves]\n# unit: nm"); }, {"line 2", "'nm'", "'waves'", "agree"});
  refused("# Pitch_mm: 0", {"Pitch_mm", "'0'"});
  refused("# pixel size: 0.5 furlongs", {"pixel size", "'0.5 furlongs'"});
  refused("# pitch_um: 250 mm", {"pitch_um", "'250 mm'", "um"});
  refused("# dx=0.5 dy=0.5", {"dx", "'0.5 dy=0.5'"});
  refused("# origin_mm: 1", {"origin_mm", "'1'", "x,y"});
  refused("# origin: x=1 mm, y=2 mm", {"origin", "'x=1 mm'"});
  refused("# nodata: grey", {"nodata", "'grey'", "nan"});
  refused("# lateral units: pixel", {"lateral units", "'pixel'"});
}

TEST(TextHeader, RefusesWhatIsSaidTwiceOrOtherwise) {
  test::expect_input_error([] { header_of("# unit: nm\n# unit: nm"); }, {"line 2", "unit", "second time"});
  test::expect_input_error([] { header_of("# unit: nm\n# Heights in um"); }, {"line 2", "'um'", "unit = 'nm'"});
  test::expect_input_error([] { header_of("# unit: nm\n# rate unit: nm/s"); }, {"line 2", "'nm/s'", "agree"});
  EXPECT_EQ(header_of("# unit: um\n# Heights in micrometres").unit, "um");
  test::expect_input_error([] { header_of("# pitch_mm: 0.5\n# pixel size: 0.4 mm"); },
                           {"line 2", "0.4", "0.5", "agree"});
  EXPECT_EQ(header_of("# pitch_mm: 0.5\n# pixel size: 500 um").pitch, (Point{0.5, 0.5}));
}

TEST(TextHeader, LeavesOtherCommentsAlone) {
  for (const char* line : {"# measured on Tuesday 12:30:05",
                           "# rows: row 1 = smallest y; columns: column 1 = smallest x",
                           "# instrument: Zygo Verifire, 633 nm",
                           "# wavelength: 632.8 nm",
                           "# operator: N. N., part no. 5",
                           "# pitch: Gugolz 64",
                           "# no data outside the aperture",
                           "# lateral resolution (optical): 3 um",
                           "# PV: 120.3 nm",
                           "# RMS 23 nm",
                           "# 5 mm aperture stop",
                           "# measured by Anna, 20 C",
                           "# unit under test",
                           "# unit number: 5",
                           "# C:/data/height.txt",
                           "# date=2024-03-01",
                           "# tool: 5 mm wheel",
                           "# z range: 12 to 30",
                           "# x: to the right, y: up",
                           "# x 0.5 mm",
                           "# scale: 1",
                           "# Step 3 of 5",
                           "# step: 3",
                           "# temperature in degrees",
                           "# average of 16 maps",
                           "# units",
                           "# ",
                           "#",
                           "# :",
                           "# =,;|",
                           "# original: part-7.dat"}) {
    const MapHeader header = header_of(line);
    EXPECT_TRUE(says_nothing(header)) << line << (header.unclear.empty() ? "" : ": " + header.unclear[0].message);
  }
  EXPECT_EQ(header_of("# made: crop, unit: um").history, std::vector<std::string>{"crop, unit: um"});
}

// The whole way: an option settles what is unclear and never what is wrong.
TEST(TextHeader, AnOptionSettlesWhatIsUnclear) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("a.csv", "# pitch: 250\n# origin: 1,2\n# scale: 1e-3\n# missing: 7\n1,2\n4,7\n");
  MapReadOptions options;
  const auto refused = [&](const std::string& key, const std::string& option) {
    test::expect_input_error([&] { read_map(file, options); }, {"a.csv", key, option});
  };
  refused("pitch = '250'", "`map pixel`");
  options.pitch = square_pitch(0.25);
  refused("origin = '1,2'", "`map origin`");
  options.origin = Point{1.0, 2.0};
  refused("scale = '1e-3'", "`map unit`");
  options.scale = 1e3;
  refused("missing = '7'", "`map no data`");
  options.no_data = NoDataMarkers{{7.0}};
  const HeightMap map = read_map(file, options);
  EXPECT_EQ(map.at(1, 0), 4e3);
  EXPECT_TRUE(std::isnan(map.at(1, 1)));
}

// A unit says nothing of a factor: nobody knows whether it is that before or after.
TEST(TextHeader, AUnitDoesNotSettleAFactor) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("a.csv", "# pitch_mm: 0.5\n# unit: um\n# gain: 2.5\n1,2\n4,7\n");
  MapReadOptions options;
  test::expect_input_error([&] { read_map(file, options); }, {"a.csv, line 3", "gain = '2.5'", "`map unit`"});
  options.scale = 1e3;
  EXPECT_EQ(read_map(file, options).at(1, 0), 4e3);
}

}  // namespace
}  // namespace dwell
