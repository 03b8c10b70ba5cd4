#include "runs/reports/map_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "tests/core/base/expect_error.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

using nlohmann::json;

/// Power, a ripple of 2 mm along x (4 nm amplitude) and one of 0.5 mm along y (1 nm), unequal pitches, two lost pixels.
HeightMap rippled() {
  HeightMap map(Grid{300, 200, 0.2, 0.1, {-5.0, 7.0}});  // 40 mm x 30 mm
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const double x = p.x - 15.0, y = p.y - 22.0;
    map.values[static_cast<std::size_t>(i)] = 0.1 * (x * x + y * y) + 3.0 * x +
                                              4.0 * std::sin(2.0 * std::numbers::pi * p.x / 2.0) +
                                              std::sin(2.0 * std::numbers::pi * p.y / 0.5);
  }
  map.at(100, 50) = map.at(100, 51) = std::nan("");
  return map;
}

MapReportOptions options() {
  MapReportOptions o;
  o.removed = parse_polynomial_spec("piston,tilt,power");
  o.form = parse_polynomial_spec("legendre:2");
  o.spectrum = true;
  o.band_edges = {10.0, 1.0};
  o.limit = parse_psd_limit("0.5,1");
  return o;
}

/// The JSON of a whole map, no aperture.
std::string json_text(const MapReport& report, const HeightMap& map, const std::vector<InputFile>& inputs = {}) {
  return map_report_json(report, map_figures(report, "a.npy", map, map.valid_pixels(), "map"), inputs);
}

TEST(MapReport, FindsWhatTheMapIsMadeOf) {
  const MapReport report = map_report(rippled(), options());
  EXPECT_NEAR(report.statistics.rms, std::sqrt(8.0 + 0.5), 0.05);
  EXPECT_NEAR(report.slope.x, 4.0 * std::numbers::pi / std::sqrt(2.0), 0.3);  // less sinc(pi 0.2 / 2) = 0.98
  EXPECT_NEAR(report.slope.y, 4.0 * std::numbers::pi / std::sqrt(2.0), 0.8);  // less sinc(pi 0.1 / 0.5) = 0.94
  ASSERT_TRUE(report.spectrum);
  const SpectrumReport& s = *report.spectrum;
  const std::vector<BandRms>& bands = s.split.bands;
  ASSERT_EQ(bands.size(), 3u);
  for (const BandRms& band : bands) ASSERT_TRUE(band.rms);
  EXPECT_EQ(s.bridged, 2);
  EXPECT_FALSE(s.holes);
  EXPECT_LE(*bands[0].rms, 0.3);
  EXPECT_NEAR(*bands[1].rms, std::sqrt(8.0), 0.05);
  EXPECT_NEAR(*bands[2].rms, std::sqrt(0.5), 0.02);
  double square = s.split.longer * s.split.longer + s.split.shorter * s.split.shorter;
  for (const BandRms& band : bands) square += *band.rms * *band.rms;
  EXPECT_NEAR(std::sqrt(square), s.rms, 1e-12);
  // The peak of 8 nm^2 in a line of Hann's width: above 0.5 / f at 0.5 /mm, nothing of it along y.
  ASSERT_TRUE(s.curves[0].limit && s.curves[1].limit);
  EXPECT_FALSE(s.curves[0].limit->met());
  EXPECT_NEAR(s.curves[0].limit->worst_frequency, 0.5, 0.02);
  EXPECT_TRUE(s.curves[1].limit->met());
  EXPECT_FALSE(s.curves[2].limit);
  EXPECT_FALSE(s.limit_met());
}

TEST(MapReport, SaysItInWords) {
  const MapReport report = map_report(rippled(), options());
  const std::string text = map_report_text(report);
  for (const char* part :
       {"PV        ", "PVr       ", "RMS       ", "(piston,tilt,power removed)", "urad RMS in x", "legendre:2",
        "unit RMS over the rectangle", "L2(x) L0(y)", "2 lost pixels bridged", "band mid", "10 - 1 mm",
        "< 1 mm (only down to two pixels, 0.2 mm)", "limit x   EXCEEDED", "limit y   met"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  MapReportOptions brief;
  brief.removed = parse_polynomial_spec("piston");
  const std::string shorter = map_report_text(map_report(rippled(), brief));
  EXPECT_EQ(std::count(shorter.begin(), shorter.end(), '\n'), 4);
}

TEST(MapReport, SaysWhichTermsWereDropped) {
  HeightMap row(Grid{1, 6, 1.0, 1.0, {}}, {0, 1, 0, 2, 0, 3});
  MapReportOptions o;
  o.removed = parse_polynomial_spec("piston,tilt");
  const std::string text = map_report_text(map_report(row, o));
  EXPECT_NE(text.find("depend on the others here: tilt y"), std::string::npos) << text;
  EXPECT_NE(text.find("none in y"), std::string::npos) << text;
  EXPECT_NE(text.find("PVr       too few pixels: 6 with data"), std::string::npos) << text;
  EXPECT_EQ(text.find("none urad"), std::string::npos) << text;
  const json j = json::parse(json_text(map_report(row, o), row));
  EXPECT_TRUE(j["figure"]["pvr_nm"].is_null());
}

TEST(MapReport, JsonHoldsAllOfIt) {
  const HeightMap map = rippled();
  const MapReport report = map_report(map, options());
  const json j = json::parse(json_text(report, map, {{"map", "a.npy", "00"}}));
  EXPECT_EQ(j["schema"], 2);
  EXPECT_EQ(j["inputs"][0]["file"], "a.npy");
  EXPECT_EQ(j["map"]["rows"], 300);
  EXPECT_EQ(j["map"]["pixel_mm"], json({0.2, 0.1}));
  EXPECT_EQ(j["map"]["rms_nm"], report.statistics.rms);
  EXPECT_EQ(j["figure"]["pvr_nm"], report.robust->pvr);
  EXPECT_EQ(j["figure"]["slope_rms_urad"]["total"], report.slope.total);
  EXPECT_EQ(j["removed_form"]["terms"].size(), 4u);
  EXPECT_EQ(j["form"]["terms"][3]["coefficient_nm"], report.form_fit.terms[3].coefficient);
  EXPECT_EQ(j["form"]["residual"]["rms_nm"], report.form_residual.rms);
  EXPECT_TRUE(j["spectrum"]["bands"][0]["longest_mm"].is_null());
  EXPECT_EQ(j["spectrum"]["x"]["frequency_per_mm"].size(), report.spectrum->curves[0].curve.frequency.size());
  EXPECT_EQ(j["spectrum"]["radial"]["density_nm2_mm2"].size(), report.spectrum->curves[2].curve.density.size());
  EXPECT_EQ(j["spectrum"]["x"]["limit"]["met"], false);
  EXPECT_EQ(j["spectrum"]["y"]["limit"]["met"], true);
}

TEST(MapReport, PictureShowsCurvesBandsAndLimit) {
  const auto picture = testing::decode_png(psd_picture(map_report(rippled(), options()), "title"));
  std::size_t red = 0, shaded = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      red += picture.at(x, y) == Colour{200, 30, 30};
      shaded += picture.at(x, y) == Colour{244, 246, 232};
    }
  }
  EXPECT_GT(red, 200u);  // a dashed line of three pixels; those at its rim are blended
  EXPECT_GT(shaded, 50000u);
  MapReportOptions brief;
  EXPECT_THROW(psd_picture(map_report(rippled(), brief), ""), std::invalid_argument);
}

TEST(BandEdges, AreDescendingWavelengths) {
  EXPECT_EQ(parse_band_edges("33, 0.12"), (std::vector<double>{33.0, 0.12}));
  EXPECT_EQ(parse_band_edges("5"), (std::vector<double>{5.0}));
  for (const char* text : {"", "0", "1,2", "3,3", "nan", "5,-1", "5,,1", "inf,2", "1e-320"}) {
    test::expect_input_error([&] { parse_band_edges(text); }, {text, "descending"});
  }
}

TEST(BandRms, SaysWhatAMapCannotShow) {
  HeightMap map(Grid{40, 50, 0.2, 0.2, {}}, std::vector<double>(2000, 1.0));
  const ArealPsd psd = areal_psd(map, {});
  const std::vector<BandRms> bands = band_rms(psd, {33.0, 20.0, 2.0, 0.12}).bands;
  EXPECT_EQ(bands[0].name, "1");
  EXPECT_NE(bands[0].note.find("10 mm long"), std::string::npos);
  EXPECT_NE(bands[1].note.find("not resolved"), std::string::npos);
  EXPECT_NE(bands[2].note.find("only up to the 10 mm"), std::string::npos);
  EXPECT_NE(bands[3].note.find("only down to two pixels, 0.4 mm"), std::string::npos);
  EXPECT_NE(bands[4].note.find("two pixels are 0.4 mm"), std::string::npos);
  EXPECT_EQ(wavelengths_text(bands[0]), "> 33 mm");
  EXPECT_EQ(wavelengths_text(bands[3]), "2 - 0.12 mm");
  EXPECT_EQ(wavelengths_text(bands[4]), "< 0.12 mm");
}

/// 10 mm x 8 mm: tilt, which the window spreads over everything longer than the part, and a chequerboard, whose waves
/// run along the diagonal and are shorter than two pixels.
HeightMap tilted_chequerboard() {
  HeightMap map(Grid{40, 50, 0.2, 0.2, {-3.0, 1.0}});
  for (Index r = 0; r < 40; ++r) {
    for (Index c = 0; c < 50; ++c) {
      map.at(r, c) = 0.3 * static_cast<double>(c) + 0.1 * static_cast<double>(r) + ((r + c) % 2 ? 2.0 : -2.0);
    }
  }
  return map;
}

TEST(BandRms, GivesNoNumberToBandsThatAreNotResolved) {
  // Of the density itself, sample by sample: what is longer than the part, and what is in the one resolved band.
  const ArealPsd psd = areal_psd(tilted_chequerboard(), {});
  double longer = 0.0, mid = 0.0, shorter = 0.0;
  for (Index r = 0; r < psd.rows; ++r) {
    for (Index c = 0; c < psd.half_cols(); ++c) {
      const double f = std::hypot(psd.frequency_y(r), psd.step_x * static_cast<double>(c));
      const double power = psd.multiplicity(c) * psd.density[static_cast<std::size_t>(r * psd.half_cols() + c)];
      (f < 0.0999999 ? longer : f < 1.0 / 0.4 ? mid : shorter) += power * psd.step_x * psd.step_y;
    }
  }
  ASSERT_GT(longer, 1.0);
  ASSERT_NEAR(shorter, 4.0, 0.1);
  const BandSplit split = band_rms(psd, {20.0, 0.4});
  ASSERT_EQ(split.bands.size(), 3u);
  EXPECT_FALSE(split.bands[0].rms);
  ASSERT_TRUE(split.bands[1].rms);
  EXPECT_FALSE(split.bands[2].rms);
  EXPECT_NEAR(split.longer, std::sqrt(longer), 1e-9);
  EXPECT_NEAR(*split.bands[1].rms, std::sqrt(mid), 1e-9);
  EXPECT_NEAR(split.shorter, std::sqrt(shorter), 1e-9);
}

TEST(MapReport, SaysWhichBandsAreNotResolvedInWordsAndJson) {
  MapReportOptions o;
  o.removed = parse_polynomial_spec("none");
  o.spectrum = true;
  o.band_edges = {20.0, 0.4};
  const HeightMap map = tilted_chequerboard();
  const MapReport report = map_report(map, o);
  const std::string text = map_report_text(report);
  for (const char* part : {"band form  wavelengths > 20 mm not resolved: the part is 10 mm long\n",
                           "longer than the part resolves, > 10 mm", "band rough wavelengths < 0.4 mm not resolved",
                           "in the bands shorter than two pixels", "(plain RMS "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  const json s = json::parse(json_text(report, map))["spectrum"];
  EXPECT_TRUE(s["bands"][0]["rms_nm"].is_null());
  EXPECT_EQ(s["bands"][0]["note"], "not resolved: the part is 10 mm long");
  EXPECT_TRUE(s["bands"][1]["rms_nm"].is_number());
  EXPECT_EQ(s["longer_than_resolved_rms_nm"], report.spectrum->split.longer);
  EXPECT_EQ(s["shorter_than_resolved_rms_nm"], report.spectrum->split.shorter);
}

}  // namespace
}  // namespace dwell
