#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/form/map_statistics.h"
#include "core/removal/removal_once.h"
#include "core/tif/models/removal_models.h"
#include "paths/feed/depth_feed.h"
#include "paths/lines/multi_pitch.h"
#include "paths/metrics/ripple.h"
#include "tests/oracle/dense_algebra.h"
#include "tests/paths/domain/path_test_util.h"

// Hou, Liao, Wang 2017, "Development of multi-pitch tool path in computer-controlled optical surfacing processes"
// (https://doi.org/10.1186/s41476-017-0050-z), section "Results and discussion"; docs/papers.md has the figures beside
// each other. Their removal function is not published. Ours is the MRF model with a tail of 1.2 mm and a width of 1.5
// mm whose steep side is such (0.35 mm) that lines 0.8 mm apart across the flow leave 10 % of the removal, as theirs do
// in V4 (0.06 wavelengths at about 0.38 um); its volume rate is what their first pitch asks for.
namespace dwell {
namespace {

constexpr double kDeepest = 443.0;                                  // [nm]
constexpr double kFastest = 50.0;                                   // [mm/s]
constexpr double kLambda = 632.8;                                   // [nm]
constexpr double kUniform = 0.8;                                    // [mm]
constexpr double kVolume = kUniform * (kDeepest / 8.0) * kFastest;  // eq. 10 for r_1 = dr / 2: 2215 nm mm^2/s

RemovalFunction theirs() {
  const RemovalFunction shape =
      removal_of_spec(parse_spec_text("mrf:lead=0.3498,trail=1.2,width=1.5,angle=90,peak=1", "tif"));
  HeightMap rates = shape.samples;
  for (double& rate : rates.values) rate *= kVolume / shape.volume;
  return measured_removal(rates, {TifCentre::Kind::Given, {}});
}

TEST(HouLiaoWang, PitchesOfFourRanges) {
  const auto ranges = pitches_by_depth({0.0, 0.25 * kDeepest, 0.5 * kDeepest, 0.75 * kDeepest, kDeepest}, kVolume,
                                       kFastest, 0.01, 2.0 * theirs().radius / 6.0);
  const std::vector<double> by_equations{0.8, 0.4, 0.2, 0.8 / 6.0};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(ranges[k].pitch, by_equations[k], 1e-12);
  // The paper's 0.8, 0.395, 0.132, 0.099 mm are those of r = 1, 2, 6, 8 times dr / 2 (with its ranges' 0.0633 um for
  // dr / 2), to the rounding of its first.
  const double half = 63.3, volume = 0.395 * 2.0 * half * kFastest;
  const std::vector<double> factors{1.0, 2.0, 6.0, 8.0}, printed{0.8, 0.395, 0.132, 0.099};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(volume / (factors[k] * half * kFastest), printed[k], 0.013 * printed[k]);
  }
}

/// Where two straight lines that meet fit PVn over pitch best (least squares): the pitch of their meeting.
double knee(const TrackProfile& line, double to) {
  std::vector<double> x, y;
  for (double pitch = 0.1; pitch < to + 1e-9; pitch += 0.05) {
    x.push_back(pitch);
    y.push_back(raster_ripple(line, pitch, 1.0).pvn);
  }
  double best = std::numeric_limits<double>::infinity(), at = 0.0;
  for (double bend = 0.2; bend < to - 0.1; bend += 0.01) {
    Eigen::MatrixXd basis(static_cast<Index>(x.size()), 3);
    for (std::size_t i = 0; i < x.size(); ++i) {
      basis.row(static_cast<Index>(i)) << 1.0, x[i], std::max(0.0, x[i] - bend);
    }
    const Eigen::Map<const Eigen::VectorXd> values(y.data(), static_cast<Index>(y.size()));
    const Eigen::VectorXd fit = oracle::least_squares_by_qr(basis, values);
    const double error = (basis * fit - values).squaredNorm();
    if (error < best) best = error, at = bend;
  }
  return at;
}

TEST(HouLiaoWang, RippleGrowsWithDepthAndWithPitch) {
  const RemovalFunction tif = theirs();  // flows along y
  const TrackProfile across = line_profile(tif, 0.0), along = line_profile(tif, 90.0);
  for (const double depth : {100.0, 200.0, 300.0, 400.0}) {
    EXPECT_NEAR(raster_ripple(across, kUniform, depth).pve, 0.1 * depth, 0.002 * depth);
  }
  EXPECT_NEAR(raster_ripple(across, 0.4, 1.0).pvn, 0.008, 0.0005);
  EXPECT_LT(raster_ripple(across, 0.2, 1.0).pvn, 0.001);
  EXPECT_NEAR(raster_ripple(across, 1.1, 1.0).pvn, 0.24, 0.01);
  EXPECT_NEAR(raster_ripple(along, 1.1, 1.0).pvn, 0.0054, 0.0005);
  EXPECT_NEAR(raster_ripple(along, 1.5, 1.0).pvn, 0.11, 0.01);
  EXPECT_NEAR(knee(along, 1.5), 1.21, 0.03) << "theirs: about 1.1 mm";
  EXPECT_NEAR(knee(across, 1.5), 0.68, 0.03);
}

/// A part whose removal depth grows from 0 to 443 nm along the lines, so that every range is a band across which the
/// ripple can be read at one depth.
HeightMap slope(double pitch_x, double pitch_y) {
  const auto cols = static_cast<Index>(std::lround(200.0 / pitch_x)) + 1;
  const auto rows = static_cast<Index>(std::lround(30.0 / pitch_y)) + 1;
  HeightMap map(Grid{rows, cols, pitch_x, pitch_y, {-100.0, 40.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    map.values[static_cast<std::size_t>(i)] = -60.0 + kDeepest * (map.grid.centre(i).x + 100.0) / 200.0;
  }
  return map;
}

/// A path polished at the feeds of eq. 12.
struct Polished {
  MultiPitchPath plan;
  DepthFeed feed;
  std::vector<Stroke> strokes;

  explicit Polished(const std::vector<double>& pitches) {
    MultiPitchOptions options;
    options.pitches = pitches;
    options.step = 0.3;
    const HeightMap target = slope(0.5, 0.6);
    plan = multi_pitch_path(target, theirs(), kFastest, options);
    feed = depth_feed(target, plan.path, plan.pitch_of_points(), {kVolume, plan.lowest, kFastest, plan.step});
    strokes = moving_strokes(plan.path);
  }

  HeightMap removal(const Grid& grid) const {
    HeightMap map(grid, std::vector<double>(static_cast<std::size_t>(grid.size()), 0.0));
    const Vector removed = removal_once(grid, finite_pixels(map), removal_kernel(theirs(), grid.pitch_x, grid.pitch_y),
                                        strokes, feed.dwell, 2);
    std::copy(removed.begin(), removed.end(), map.values.begin());
    return map;
  }

  /// Peak to valley across the lines in the middle of a range [nm].
  double ripple(int range) const {
    const Grid grid{400, 9, 0.02, 0.02, {-100.0 + 25.0 + 50.0 * range - 0.08, 51.0}};
    const HeightMap map = removal(grid);
    double low = test::kInf, high = -test::kInf;
    for (Index row = 0; row < grid.rows; ++row) {
      low = std::min(low, map.at(row, 4));
      high = std::max(high, map.at(row, 4));
    }
    return high - low;
  }

  /// Of what is left of the form, away from the ends [nm].
  double residual_pv() const {
    const Grid grid{37, 361, 0.5, 0.5, {-90.0, 46.0}};
    const HeightMap removed = removal(grid);
    HeightMap left(grid);
    for (Index i = 0; i < grid.size(); ++i) {
      const double depth = kDeepest * (grid.centre(i).x + 100.0) / 200.0;
      left.values[static_cast<std::size_t>(i)] = depth - removed.values[static_cast<std::size_t>(i)];
    }
    return map_statistics(left, {}).pv;
  }
};

TEST(HouLiaoWang, MultiPitchKeepsTheRippleOfEveryRegionBelowAHundredthOfAWavelength) {
  const Polished multi({0.8, 0.4, 0.2, 0.8 / 6.0}), uniform({kUniform});
  const std::vector<double> printed{0.008, 0.02, 0.04, 0.06};  // of lambda, V1 to V4
  for (int range = 0; range < 4; ++range) {
    EXPECT_LT(multi.ripple(range), 0.01 * kLambda) << "S" << range + 1;
    const double exact = raster_ripple(line_profile(theirs(), 0.0), kUniform, kDeepest * (2 * range + 1) / 8.0).pve;
    EXPECT_NEAR(uniform.ripple(range), exact, 0.03 * exact) << "V" << range + 1;
    EXPECT_NEAR(uniform.ripple(range) / kLambda, printed[static_cast<std::size_t>(range)], 0.007) << "V" << range + 1;
  }
}

TEST(HouLiaoWang, MultiPitchCorrectsTheFormAsWellAsTheWideRasterAndTheNarrowOneDoesNot) {
  const double multi = Polished({0.8, 0.4, 0.2, 0.8 / 6.0}).residual_pv();
  const double wide = Polished({kUniform}).residual_pv();
  const double narrow = Polished({0.8 / 6.0}).residual_pv();
  // Theirs: 0.095 um both. What is left is the shallow end, where the tool cannot pass fast enough: s / (d v) = 55 nm.
  EXPECT_LT(multi, 95.0);
  EXPECT_LT(multi, wide + 5.0);
  EXPECT_GT(narrow, 3.0 * multi);
}

}  // namespace
}  // namespace dwell
