#include "runs/plan/pitch_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paths/lines/raster.h"
#include "runs/plan/dwell_plan.h"

namespace dwell {
namespace {

/// Waves that a tool of 8 mm can follow, but not with tracks as far apart as its ripple would allow, and noise that
/// none can.
Part wavy_part() {
  HeightMap map(Grid{34, 40, 1.0, 1.0, {-11.0, 4.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 60.0 * std::sin(0.35 * p.x) * std::cos(0.3 * p.y) + 0.5 * p.y +
                                              20.0 * std::sin(12.9898 * static_cast<double>(i * i % 977));
  }
  return make_part(std::move(map), gaussian_removal(10.0, 8.0, 9.0), {true, true}, 2);
}

double left_by(const Part& part, const RasterOptions& raster, const DwellOptions& options = {}) {
  PathSpec spec = parse_path_spec("raster:pitch=1");
  spec.options = raster;
  return find_dwell(part, lay_path(part, spec, Motion::Moving, 50.0), options, {}, ExactCheck::Figure)
      .exact.statistics.rms_about_zero();
}

TEST(PitchChoice, LeavesNoMoreThanHalfThePitchWould) {
  const Part part = wavy_part();
  const PathSpec spec = parse_path_spec("raster:pitch=auto,angle=90");
  ASSERT_TRUE(pitch_is_searched(spec));
  EXPECT_FALSE(pitch_is_searched(parse_path_spec("raster:pitch=2")));
  EXPECT_FALSE(pitch_is_searched(parse_path_spec("spiral:pitch=2")));
  std::vector<std::string> lines;
  const SearchedRaster found = lay_searched_raster(part, spec, Motion::Moving, {},
                                                   Progress{[&](const std::string& l) { lines.push_back(l); }, {}});
  const LaidPath& laid = found.laid;
  ASSERT_GE(laid.path.notes.size(), 2U);
  const std::string& ripple = laid.path.notes[laid.path.notes.size() - 2];
  EXPECT_NE(ripple.find("would allow"), std::string::npos) << ripple;
  const std::string& note = laid.path.notes.back();
  double pitch = 0.0, step = 0.0, said = 0.0;
  ASSERT_EQ(std::sscanf(note.c_str(), "pitch %lf mm, step %lf mm: RMS %lf nm", &pitch, &step, &said), 3) << note;
  EXPECT_EQ(pitch, step);
  EXPECT_LT(pitch, 6.0);  // which ripple alone would allow
  RasterOptions raster = options_of<RasterOptions>(parse_path_spec("raster:pitch=1,angle=90"));
  raster.pitch = pitch;
  const double here = left_by(part, raster);
  EXPECT_NEAR(here, said, 0.01 * said);
  raster.pitch = 0.5 * pitch;
  EXPECT_LE(here, 1.03 * left_by(part, raster));
  EXPECT_FALSE(lines.empty());
  ASSERT_TRUE(found.dwell);  // the plan of these weights is solved already
  EXPECT_EQ(found.dwell->exact.statistics.rms_about_zero(), here);
}

/// A part without noise: what is left goes on falling with any pitch, as smoothness weighs less and less.
Part smooth_part() {
  HeightMap map(Grid{14, 17, 1.0, 1.0, {-11.0, 4.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 60.0 * std::sin(0.35 * p.x) * std::cos(0.3 * p.y);
  }
  return make_part(std::move(map), gaussian_removal(10.0, 8.0, 9.0), {true, true}, 2);
}

TEST(PitchChoice, TellsAGainByThePitchFromOneByTheSmoothness) {
  const Part part = smooth_part();
  DwellOptions options;  // weights as numbers: with Auto, half the pitch is smoothed as much without a word
  options.smoothness = {0.1};
  options.time_price = {0.0};
  const LaidPath laid = lay_searched_raster(part, parse_path_spec("raster:pitch=auto"), Motion::Moving, options).laid;
  const std::string& note = laid.path.notes.back();
  double pitch = 0.0, here = 0.0, half = 0.0, equal = 0.0;
  ASSERT_EQ(std::sscanf(note.c_str(),
                        "pitch %lf mm, step %*f mm: RMS %lf nm with %*d dwell points; pitch %*f mm, step %*f mm: RMS "
                        "%lf nm with %*d dwell points, since a smoothness of 0.1 weighs 1/16 there of what it does "
                        "here; with 1.6, which weighs the same, RMS %lf nm.",
                        &pitch, &here, &half, &equal),
            4)
      << note;
  EXPECT_GE(pitch, 1.0);  // an eighth of the FWHM
  EXPECT_GT(here, 1.02 * half);
  EXPECT_LE(here, 1.02 * equal);
  // What the note promises: the pitch at hand gains as much by a lower smoothness.
  RasterOptions raster = options_of<RasterOptions>(parse_path_spec("raster:pitch=1"));
  raster.pitch = pitch;
  DwellOptions lower = options;
  lower.smoothness = {0.1 / 16.0};
  EXPECT_LE(left_by(part, raster, lower), 1.1 * half);
}

TEST(PitchChoice, ReturnsTheBestSoFarWhenItsTimeIsOver) {
  const Part part = wavy_part();
  DwellOptions options;
  options.smoothness = {0.1};
  options.time_price = {0.0};  // its search is set-up as well
  options.max_seconds = 1e-9;  // the set-up has a second, the first solve no time
  const SearchedRaster found = lay_searched_raster(part, parse_path_spec("raster:pitch=auto"), Motion::Moving, options);
  ASSERT_TRUE(found.dwell);
  EXPECT_EQ(static_cast<std::size_t>(found.dwell->seconds.size()), found.laid.path.size());
  ASSERT_FALSE(found.dwell->limits.empty());
  EXPECT_NE(found.dwell->limits.back().find("had compared narrower pitches"), std::string::npos);
  EXPECT_NE(found.laid.path.notes.back().find("no time to compare"), std::string::npos);
}

TEST(PitchChoice, KeepsAStepThatIsGiven) {
  const LaidPath laid =
      lay_searched_raster(wavy_part(), parse_path_spec("raster:pitch=auto,step=1.5"), Motion::Moving, {}).laid;
  EXPECT_NEAR(distance(laid.path.points[20], laid.path.points[21]), 1.5, 1e-6);
}

TEST(PitchChoice, Stops) {
  EXPECT_THROW(lay_searched_raster(wavy_part(), parse_path_spec("raster:pitch=auto"), Motion::Moving, {},
                                   Progress{{}, [] { return true; }}),
               Interrupted);
}

}  // namespace
}  // namespace dwell
