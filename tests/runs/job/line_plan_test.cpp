/// A plan along a line against dense algebra that shares no code with it: the removal of every stroke by quadrature,
/// the least residual by active sets.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "runs/job/planned_job.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/oracle/dense_algebra.h"
#include "tests/oracle/nnls_oracle.h"

namespace dwell {
namespace {

constexpr double kLineFwhm = 8.0, kLinePeak = 1.0, kLineReach = 14.0;  // of the tool [mm, nm/s]

/// Positions and weights of Gauss's rule with three points within -1/2..1/2.
constexpr double kGauss[3] = {-0.3872983346207417, 0.0, 0.3872983346207417};
constexpr double kGaussWeights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

double tool_rate(double x, double y) {
  const double r2 = x * x + y * y;
  return r2 > kLineReach * kLineReach ? 0.0
                                      : kLinePeak * std::exp(-4.0 * std::numbers::ln2 * r2 / (kLineFwhm * kLineFwhm));
}

/// What a second removes on the mean of a pixel at (x, 0) while the tool runs evenly from one end of a stretch to the
/// other [nm/s].
double removal_of_stroke(double x, double pitch, double from, double to) {
  constexpr int kPieces = 24;
  double sum = 0.0;
  for (int k = 0; k < kPieces; ++k) {
    const double tool = from + (to - from) * (k + 0.5) / kPieces;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        sum += kGaussWeights[i] * kGaussWeights[j] * tool_rate(x + pitch * kGauss[i] - tool, pitch * kGauss[j]);
    }
  }
  return sum / kPieces;
}

/// A plan of a profile on a single track, for the least residual: no price of time, no smoothness.
JobOptions line_job(const std::string& profile, const std::string& out, const std::string& step) {
  JobOptions options;
  options.line_profile = profile;
  options.tif = fmt::format("gaussian:peak={},fwhm={},radius={}", kLinePeak, kLineFwhm, kLineReach);
  options.path = parse_path_spec("line:step=" + step);
  options.smoothness = {0.0};
  options.time_price_nm2_per_s = {0.0};
  options.max_feed_mm_per_min = 60000.0;
  options.threads = 1;
  options.out = out;
  return options;
}

/// The least RMS that any dwell on this path leaves of the figure, above the least times that the feed allows.
double least_rms(const PlannedJob& plan) {
  const HeightMap& figure = plan.part().figure;
  const Grid& g = figure.grid;
  const auto& strokes = plan.laid.strokes;
  const double fastest = plan.job.options.max_feed_mm_per_min / 60.0;
  Eigen::MatrixXd a(g.cols, static_cast<Eigen::Index>(strokes.size())), form(g.cols, 2);
  Eigen::VectorXd wanted(g.cols);
  for (Index col = 0; col < g.cols; ++col) {
    form.row(col) << 1.0, g.x(col) - g.x(0);
    wanted[col] = figure.at(0, col);
    for (std::size_t j = 0; j < strokes.size(); ++j) {
      const double from = strokes[j].start.x, to = strokes[j].finish.x;
      const double each = removal_of_stroke(g.x(col), g.pitch_x, from, to);
      a(col, static_cast<Eigen::Index>(j)) = each;
      wanted[col] -= each * std::abs(to - from) / fastest;
    }
  }
  if (plan.part().form.any()) {  // piston and tilt do not count
    const Eigen::MatrixXd q = oracle::thin_qr(form).q;
    a -= q * (q.transpose() * a);
    wanted -= q * (q.transpose() * wanted);
  }
  const Eigen::VectorXd left = wanted - a * oracle::nnls(a, wanted);
  return std::sqrt(left.squaredNorm() / static_cast<double>(g.cols));
}

void expect_best(const PlannedJob& plan, const WrittenPlan& written) {
  const double solved = plan.dwell.residual.rms_about_zero(), least = least_rms(plan);
  const double simulated = written.exact.statistics.rms_about_zero();
  std::cout << fmt::format(
      "solver {:.6g} nm RMS, dense NNLS {:.6g}, program simulated {:.6g}; slope {:.4g} -> {:.4g} urad\n", solved, least,
      simulated, written.surface.before.slope.total, written.surface.after.slope.total);
  EXPECT_NEAR(solved, least, 0.01 * least);
  EXPECT_NEAR(simulated, solved, 0.01 * solved);
}

/// With the weights that a plan finds by itself: the same as by the dense solver.
void expect_same_by_dense_solver(JobOptions options) {
  options.smoothness = JobOptions().smoothness;
  options.time_price_nm2_per_s = JobOptions().time_price_nm2_per_s;
  const PlannedJob usual = plan_job(options, {});
  options.smoothness = {usual.dwell.weights.smoothness};
  options.time_price_nm2_per_s = {usual.dwell.weights.time_price};
  options.solver = SolverKind::DenseNnls;
  const double dense = plan_job(options, {}).dwell.residual.rms_about_zero();
  EXPECT_NEAR(usual.dwell.residual.rms_about_zero(), dense, 0.01 * dense);
}

/// Slopes of a mirror with three waves, one of them shorter than the tool can remove, at places that are not symmetric.
std::string made_up_profile() {
  std::string text = "x_mm slope_urad\n";
  for (int i = 0; i < 211; ++i) {
    const double x = -31.5 + 0.6 * i;
    text += fmt::format(
        "{:.4f} {:.9f}\n", x,
        0.8 * std::sin(0.11 * x) + 0.5 * std::cos(0.31 * x + 0.4) + 1.5 * std::sin(2.5 * x + 0.002 * x * x));
  }
  return text;
}

TEST(LinePlan, LeavesWhatDenseNonNegativeLeastSquaresLeaves) {
  const test::TemporaryFolder folder;
  JobOptions options =
      line_job(folder.file("line.txt", made_up_profile()).string(), (folder.path() / "plan").string(), "4");
  options.remove = {};  // with a free piston the least residual would be one of days of dwell
  const PlannedJob plan = plan_job(options, {});
  EXPECT_EQ(plan.part().map.grid.rows, 1);
  EXPECT_EQ(plan.laid.path.kind, "line");
  expect_best(plan, write_plan(plan, OutputFolder(options.out, plan_files()), {}));
  expect_same_by_dense_solver(options);
}

TEST(LinePlan, OverAWidthIsAnAreaForARaster) {
  const test::TemporaryFolder folder;
  JobOptions options =
      line_job(folder.file("line.txt", made_up_profile()).string(), (folder.path() / "plan").string(), "4");
  options.line_width_mm = 6.0;
  options.path = parse_path_spec("raster:pitch=2,step=4");
  const PlannedJob plan = plan_job(options, {});
  EXPECT_EQ(plan.part().map.grid.rows, 10);
  EXPECT_NEAR(plan.part().map.grid.origin.y, -2.7, 1e-9);
  EXPECT_LT(plan.dwell.residual.rms, 0.5 * plan.part().before.rms);
}

TEST(LinePlan, OfAMeasuredEllipseMeetsItsTargets) {
  const std::string file = DWELL_SHARED_DATA "/line-profiles/dabam-021.dat";
  if (!std::filesystem::exists(file)) {
    std::cerr << "\n*** NOT TESTED: a measured mirror along a line, since there is no " << file << " ***\n\n";
    GTEST_SKIP() << "no " << file;
  }
  const test::TemporaryFolder folder;
  JobOptions options = line_job(file, (folder.path() / "plan").string(), "4");
  options.profile_unit = "mm,-urad";
  options.profile_remove = "ellipse:p=7500,q=2500,angle=0.6";
  const PlannedJob plan = plan_job(options, {});
  const WrittenPlan written = write_plan(plan, OutputFolder(options.out, plan_files()), {});
  EXPECT_GE(written.surface.before.slope.total, 0.45);
  EXPECT_LE(written.surface.before.slope.total, 0.52);
  expect_best(plan, written);
  expect_same_by_dense_solver(options);
}

TEST(LinePlan, RefusesWhatBelongsToTheOtherSource) {
  const test::TemporaryFolder folder;
  const JobOptions job =
      line_job(folder.file("line.txt", made_up_profile()).string(), (folder.path() / "plan").string(), "4");
  const auto refused = [&](auto change, std::initializer_list<std::string> words) {
    JobOptions options = job;
    change(options);
    test::expect_input_error([&] { plan_job(options, {}); }, words);
  };
  refused([](auto& o) { o.map = "a.csv"; }, {"--map a.csv: beside --line-profile", "one of the two"});
  refused([](auto& o) { o.map_unit = "um"; }, {"--map-unit um: beside --line-profile"});
  refused([](auto& o) { o.wavelength_nm = 632.8; }, {"--wavelength 632.8: beside"});
  refused(
      [](auto& o) {
        o.line_profile = "";
        o.map = "a.csv";
        o.profile_unit = "mm,urad";
      },
      {"--profile-unit mm,urad: of --line-profile, which is not given"});
  refused(
      [](auto& o) {
        o.line_profile = "";
        o.line_width_mm = 3.0;
      },
      {"--line-width 3: of --line-profile"});
  refused([](auto& o) { o.profile_columns = "x,phase"; }, {"`profile columns`: no column is named 'phase'"});
  refused([](auto& o) { o.profile_unit = "mm,mrad"; }, {"`profile unit` says 'mrad'"});
  refused([](auto& o) { o.line_width_mm = 1.0; }, {"`line width` = 1 mm", "0.6 mm"});
}

TEST(LinePlan, WarnsOfAFormThatWasNotTakenOut) {
  const test::TemporaryFolder folder;
  std::string text = "x_mm slope_urad\n";
  for (int i = 0; i < 120; ++i) text += fmt::format("{} {}\n", i, 3.0 * i + std::sin(0.3 * i));
  JobOptions options = line_job(folder.file("line.txt", text).string(), (folder.path() / "plan").string(), "4");
  options.max_solve_s = 20.0;
  const Job job = load_job(options);
  ASSERT_EQ(job.notes.size(), 1u);
  EXPECT_NE(job.notes[0].find("line.txt: the heights span 5."), std::string::npos) << job.notes[0];
  options.profile_remove = "sphere";
  EXPECT_TRUE(load_job(options).notes.empty());
}

}  // namespace
}  // namespace dwell
