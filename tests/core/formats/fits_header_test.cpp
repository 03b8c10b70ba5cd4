#include "core/formats/fits_header.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/fits.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/fits_test_file.h"

namespace dwell {
namespace {

using test::FitsUnit;

std::string map_bytes(const std::vector<std::string>& cards) {
  return test::fits_file({FitsUnit{"", 3, 2, {1, 2, 3, 4, 5, 6}, cards}});
}

MapSource read_with(const std::vector<std::string>& cards) { return parse_fits(map_bytes(cards), "map a.fits"); }

void refused(const std::vector<std::string>& cards, std::initializer_list<std::string> words) {
  test::expect_input_error([&] { read_with(cards); }, words);
}

TEST(FitsHeader, KnowsWordsOfUnits) {
  for (const char* unit : {"m", "meter", "Metres"}) {
    const MapSource source = read_with({"CDELT1  = 0.0005", "CDELT2  = 0.0010", fmt::format("CUNIT1  = '{}'", unit),
                                        fmt::format("CUNIT2  = '{}'", unit)});
    ASSERT_TRUE(source.header.pitch) << unit;
    EXPECT_DOUBLE_EQ(source.header.pitch->x, 0.5) << unit;
    EXPECT_DOUBLE_EQ(source.header.pitch->y, 1.0) << unit;
  }
  EXPECT_EQ(read_with({"BUNIT   = 'microns '"}).header.unit, "microns");
  EXPECT_EQ(read_with({"ZUNIT   = 'um'"}).header.unit, "um");
  refused({"BUNIT   = 'um'", "ZUNIT   = 'nm'"}, {"map a.fits", "BUNIT = 'um'", "ZUNIT = 'nm'", "agree"});
  refused({"WFUNIT  = 'nm'"}, {"FITS keyword WFUNIT = 'nm'", "unit of the heights"});
  EXPECT_FALSE(read_with({"TIMEUNIT= 's'"}).header.unit);
}

TEST(FitsHeader, KnowsThePitchOfOtherPrograms) {
  EXPECT_EQ(read_with({"PUPLSCAL= 0.0005"}).header.pitch, (Point{0.5, 0.5})) << "poppy: m a pixel";
  EXPECT_EQ(read_with({"PIXELSCL= 0.0005", "PIXUNIT = 'meter'"}).header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(read_with({"PIXSCALE= 5.0D-1 / [mm] on the part"}).header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(read_with({"PIXSIZE1= 500 / size [um/pix]", "PIXSIZE2= 250 / [um/pix]"}).header.pitch, (Point{0.5, 0.25}));
  EXPECT_EQ(read_with({"PUPLSCAL= 0.0005", "PIXELSCL= 0.0005", "PIXUNIT = 'meter'"}).header.pitch, (Point{0.5, 0.5}));
  refused({"PUPLSCAL= 0.0005", "PITCHMM = 0.4"}, {"PUPLSCAL = 0.0005", "PITCHMM = 0.4", "agree"});
  refused({"PUPLSCAL= 0.0005", "CDELT1  = 0.4", "CDELT2  = 0.4", "CUNIT1  = 'mm'", "CUNIT2  = 'mm'"},
          {"PUPLSCAL = 0.0005", "CDELT", "0.4 and 0.4 mm", "agree"});
  refused({"PUPLSCAL= -1.0"}, {"PUPLSCAL = -1", "> 0"});
}

TEST(FitsHeader, NamesWhatMayBeAPitch) {
  for (const char* card : {"PIXSCALE= 0.5", "PIXELSCL= 0.5", "DIFFELEM= 0.5", "XPIXSZ  = 3.45", "SCALE   = 0.5",
                           "PIXUNIT = 'arcsec'", "PUPLDIAM= 6.5", "CDELT1  = 0.5"}) {
    const MapSource source = read_with({card, "PIXELSCL= 0.25"});
    EXPECT_FALSE(source.header.pitch) << card;
    const std::string name = std::string(card).substr(0, std::string(card).find_first_of("= "));
    if (name == "PIXUNIT") continue;
    EXPECT_NE(source.pitch_hint.find("FITS keyword " + name + " = "), std::string::npos) << source.pitch_hint;
  }
}

TEST(FitsHeader, ReadsUnitsUnderNamesOfTheValues) {
  EXPECT_EQ(read_with({"HEIGHT  = 'um'"}).header.unit, "um");
  EXPECT_EQ(read_with({"BTYPE   = 'height [um]'"}).header.unit, "um");
  EXPECT_EQ(read_with({"Z       = 'micron'"}).header.unit, "micron");
  EXPECT_TRUE(read_with({"BTYPE   = 'height'"}).header.unclear.empty());
}

TEST(FitsHeader, KeepsWhatRemarksAndOtherKeywordsMaySay) {
  using About = UnclearStatement::About;
  const auto expect = [](const std::string& card, About about, const std::string& word) {
    const MapSource source = read_with({card});
    ASSERT_EQ(source.header.unclear.size(), 1u) << card;
    EXPECT_EQ(source.header.unclear[0].about, about) << card;
    EXPECT_NE(source.header.unclear[0].message.find(word), std::string::npos) << source.header.unclear[0].message;
  };
  expect("COMMENT heights in um", About::Unit, "FITS COMMENT: 'heights in um'");
  expect("HISTORY values written in nm", About::Unit, "FITS HISTORY");
  expect("COMMENT row 0 = top", About::Rows, "orientation");
  expect("FLIPY   =                    T", About::Rows, "FLIPY = 1");
  expect("NOTE    = 'residual, microns'", About::Unit, "FITS keyword NOTE");
  expect("GAIN    = 2.5", About::Factor, "GAIN = 2.5");
  expect("OBJECT  = 'mirror 5' / heights in um", About::Unit, "comment behind keyword OBJECT");
  expect("DATAMAX =                  4.0 / [um] largest height", About::Unit, "comment behind keyword DATAMAX");
  EXPECT_NE(read_with({"LTV1    = 12.0"}).unclear_origin.find("LTV1 = 12"), std::string::npos);
  for (const char* card :
       {"SIMPLE  =                    T / conforms to FITS standard", "DATAMAX =                  4.0 / largest value",
        "FOCUS   =                 12.0 / focal length in mm", "EXPTIME =                  3.0 / [s] exposure time",
        "OBSERVER= 'Anna    ' / who measured", "HISTORY flipped in y by the pipeline", "COMMENT measured by Anna",
        "FLIPY   =                    F", "LTV1    = 0.0", "OBJECT  = 'mirror 5'", "GAIN    = 1.0"}) {
    const MapSource source = read_with({card});
    EXPECT_TRUE(source.header.unclear.empty()) << card;
    EXPECT_EQ(source.unclear_origin, "") << card;
  }
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.fits", map_bytes({"PITCHMM = 0.5", "COMMENT heights in um"}));
  test::expect_input_error([&] { read_map(path); }, {"a.fits", "heights in um", "`map unit`"});
  MapReadOptions options;
  options.scale = 1e3;
  EXPECT_EQ(read_map(path, options).values.back(), 6e3);
}

TEST(FitsHeader, NamesWhatMayBeAnOrigin) {
  EXPECT_NE(read_with({"CRVAL1  = -4.0"}).unclear_origin.find("CRVAL1 = -4 with CUNIT1 = ''"), std::string::npos);
  EXPECT_NE(read_with({"XORGSUBF= 12"}).unclear_origin.find("XORGSUBF = 12"), std::string::npos);
  EXPECT_EQ(read_with({"XORGSUBF= 0", "ORIGIN  = 'a workshop'"}).unclear_origin, "");
  EXPECT_EQ(read_with({"CTYPE1  = 'RA---TAN'", "CRVAL1  = 83.6", "CUNIT1  = 'deg'"}).unclear_origin, "");
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.fits", map_bytes({"PITCHMM = 0.5", "CRVAL1  = -4.0"}));
  test::expect_input_error([&] { read_map(path); }, {"a.fits", "CRVAL1 = -4", "`map origin`"});
}

TEST(FitsHeader, AsksWhichWayItsAxesRun) {
  for (const char* card : {"CTYPE1  = 'Y'", "CTYPE2  = 'X'", "CDELT1  = -0.5", "CROTA2  = 90.0", "CD1_2   = 0.5",
                           "ROWORDER= 'TOP-DOWN'"}) {
    const MapHeader header = read_with({card}).header;
    ASSERT_FALSE(header.unclear.empty()) << card;
    EXPECT_EQ(header.unclear[0].about, UnclearStatement::About::Rows) << card;
  }
  const MapHeader scaled = read_with({"PITCHMM = 0.5", "SCALE   = 0.001"}).header;
  ASSERT_EQ(scaled.unclear.size(), 1u);
  EXPECT_NE(scaled.unclear[0].message.find("SCALE = 0.001 looks like a factor"), std::string::npos);
  EXPECT_NE(read_with({"PITCHMM = 0.5", "CRPIX1  = 6.0"}).unclear_origin.find("CRPIX1 = 6"), std::string::npos);
  EXPECT_NE(read_with({"X       = 12.0"}).unclear_origin.find("X = 12"), std::string::npos);
  for (const char* card : {"CTYPE1  = 'X'", "CTYPE1  = 'RA---TAN'", "CTYPE1  = 'LINEAR'", "CRPIX1  = 1.0",
                           "ROWORDER= 'BOTTOM-UP'", "TITLE   = 'surface, nm RMS 3.4'", "SCALE   = 1.0"}) {
    const MapSource source = read_with({card});
    EXPECT_TRUE(source.header.unclear.empty()) << card;
    EXPECT_EQ(source.unclear_origin, "") << card;
  }
}

// A file is named after one of its arrays: the pupil beside an OPD is none.
TEST(FitsHeader, TheNameOfAFileMayBeThatOfAnotherImage) {
  const test::TemporaryFolder folder;
  const auto unit = [](const char* name) {
    return FitsUnit{name, 3, 2, {1, 2, 3, 4, 5, 6}, {"PITCHMM =                  0.5"}};
  };
  const auto both = folder.file("a_opd.fits", test::fits_file({unit("PUPIL"), unit("OPD")}));
  EXPECT_EQ(read_map(both.string() + ":PUPIL").at(1, 2), 6.0);
  test::expect_input_error([&] { read_map(both.string() + ":OPD"); }, {"wavefront"});
  const auto other = folder.file("b_opd.fits", test::fits_file({unit("A"), unit("B")}));
  test::expect_input_error([&] { read_map(other.string() + ":A"); }, {"the name of the file", "wavefront"});
}

TEST(FitsHeader, RefusesAxesThatAreTurned) {
  const std::vector<std::string> world{"CUNIT1  = 'mm'", "CUNIT2  = 'mm'", "CDELT1  = 0.5", "CDELT2  = 0.5"};
  for (const char* card : {"CROTA2  = 10.0", "PC1_2   = 0.1", "PC1_1   = 0.5"}) {
    std::vector<std::string> cards = world;
    cards.emplace_back(card);
    refused(cards, {std::string(card).substr(0, 5), "is required"});
  }
}

TEST(FitsHeader, TakesMarkersOfNoData) {
  const auto expect = [](const std::vector<std::string>& cards, const char* said) {
    const MapSource source = read_with(cards);
    EXPECT_TRUE(std::isnan(source.values.at(4))) << cards.front();
    EXPECT_EQ(source.values.at(3), 4.0);
    ASSERT_EQ(source.header.history.size(), 1u);
    EXPECT_EQ(source.header.history.front(), said);
  };
  expect({"BLANK   = 5"}, "read FITS: pixels without data: 1 of BLANK 5");
  EXPECT_EQ(read_with({"NODATA  = 5.0"}).header.no_data, std::vector<double>{5.0});
  refused({"NODATA  = 'grey'"}, {"NODATA = 'grey'", "a number"});
  refused({"ZSCALE  = 2.0"}, {"ZSCALE = 2", "1 (heights as they are)"});
}

// Whether a pixel's size is that before or after binning, no header says.
TEST(FitsHeader, APitchBesideBinningIsLeftOpen) {
  const std::vector<std::string> pitch{"PIXSCALE=                  0.5 / [mm] pixel"};
  const auto with = [&](const std::string& card) {
    std::vector<std::string> cards = pitch;
    cards.push_back(card);
    return read_with(cards);
  };
  ASSERT_TRUE(read_with(pitch).header.pitch);
  for (const char* card : {"XBINNING=                    2", "LTM1_1  =                  0.5", "CCDSUM  = '2 2     '",
                           "LTM2_1  =                  0.1"}) {
    const MapSource source = with(card);
    EXPECT_FALSE(source.header.pitch) << card;
    EXPECT_NE(source.pitch_hint.find(std::string(card).substr(0, 6)), std::string::npos) << source.pitch_hint;
  }
  for (const char* card : {"XBINNING=                    1", "LTM1_1  =                  1.0", "CCDSUM  = '1 1     '",
                           "LTM2_1  =                  0.0"}) {
    EXPECT_TRUE(with(card).header.pitch) << card;
  }
  const MapSource ours = read_with({"PITCHMM =                  0.5", "XBINNING=                    2"});
  EXPECT_TRUE(ours.header.pitch);
}

TEST(FitsHeader, AsksAboutWhatIsClaimedOfTheAxes) {
  for (const char* card : {"YUP     =                    F", "ANGLEDEG=                   15",
                           "MAGNITUD=                   -6", "COLUMNS = 'y       '"})
    EXPECT_FALSE(read_with({card}).header.unclear.empty()) << card;
  for (const char* card : {"YUP     =                    T", "YDOWN   =                    F"})
    EXPECT_TRUE(read_with({card}).header.unclear.empty()) << card;
}

}  // namespace
}  // namespace dwell
