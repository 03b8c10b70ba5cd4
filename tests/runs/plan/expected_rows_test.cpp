#include "runs/plan/expected_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/random_numbers.h"
#include "core/removal/removal_probe.h"
#include "core/tif/scaled_removal.h"
#include "runs/job/planned_job.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

/// The small part under a raster, its rows and its strokes.
struct UncertainPlan {
  Part part = make_part(test::small_map(), gaussian_removal(10.0, 2.5, 4.0), {true, true}, 1);
  LaidPath laid = lay_path(part, parse_path_spec("raster:pitch=1,overrun=2"), Motion::Moving, 50.0);
  std::vector<Index> pixels = finite_pixels(part.map);
  std::shared_ptr<const RemovalGeometry> geometry =
      std::make_shared<const RemovalGeometry>(removal_geometry(part.map.grid, pixels, part.kernel, laid.strokes, 1));
  std::unique_ptr<RemovalOperator> removal = make_removal_operator(*geometry);
  Vector dwell;

  UncertainPlan() {
    dwell.resize(static_cast<Index>(laid.strokes.size()));
    for (Index j = 0; j < dwell.size(); ++j) dwell[j] = 1.0 + 0.5 * std::sin(0.3 * static_cast<double>(j));
  }

  /// What the dwell removes with another tool elsewhere, from the removal function itself.
  Vector probed(const std::vector<Stroke>& strokes, double rate = 1.0, double width = 1.0) const {
    const RemovalFunction tool = scaled_removal(part.tif, rate, width);
    const PixelMeanTable table = tabulate_pixel_mean(tool, part.map.grid);
    return mean_removal(RemovalProbe(part.map.grid, table, strokes, {dwell.data(), laid.strokes.size()}), part.map.grid,
                        pixels, 1);
  }
  std::vector<Stroke> shifted(Point by) const {
    std::vector<Stroke> strokes = laid.strokes;
    for (Stroke& s : strokes) s = {s.start + by, s.via + by, s.finish + by};
    return strokes;
  }
};

TEST(ExpectedPlanRows, AreTheChangesOfTheRemovalTimesTheirDeviations) {
  UncertainPlan u;
  UncertaintySpec unsure;
  unsure.tif_rate = 0.05, unsure.tif_width = 0.03, unsure.offset = 0.2, unsure.rotation = 0.5;
  ExpectedRows expected(u.part, u.geometry, *u.removal, unsure);
  ASSERT_EQ(expected.changes().size(), 4U);
  Vector rows;
  expected.removal().apply(u.dwell, rows);
  const auto m = static_cast<Index>(u.pixels.size());
  ASSERT_EQ(rows.size(), 5 * m);
  // The middle of the map is at (3, 7) mm.
  double in_x = 0.0, in_y = 0.0;
  for (const Index pixel : u.pixels) {
    const Point p = u.part.map.grid.centre(pixel) - Point{3.0, 7.0};
    in_x += p.x * p.x / static_cast<double>(m), in_y += p.y * p.y / static_cast<double>(m);
  }
  const double turn = 0.5 * std::numbers::pi / 180.0, h = 0.02;
  const double shift_x = std::sqrt(0.04 + turn * turn * in_y), shift_y = std::sqrt(0.04 + turn * turn * in_x);
  const std::vector<Vector> changes{
      0.05 * u.probed(u.laid.strokes),
      0.03 / (2.0 * h) * (u.probed(u.laid.strokes, 1.0, 1.0 + h) - u.probed(u.laid.strokes, 1.0, 1.0 - h)),
      shift_x / (2.0 * h) * (u.probed(u.shifted({-h, 0.0})) - u.probed(u.shifted({h, 0.0}))),
      shift_y / (2.0 * h) * (u.probed(u.shifted({0.0, -h})) - u.probed(u.shifted({0.0, h})))};
  for (Index k = 0; k < 4; ++k) {
    const Vector& change = changes[static_cast<std::size_t>(k)];
    EXPECT_LE((rows.segment((k + 1) * m, m) - change).norm(), 0.02 * change.norm()) << k;
  }
  Vector adjoint;
  const Vector any = Vector::NullaryExpr(rows.size(), [](Index i) { return std::sin(static_cast<double>(i)); });
  expected.removal().apply_adjoint(any, adjoint);
  EXPECT_NEAR(adjoint.dot(u.dwell), any.dot(rows), 1e-9 * any.norm() * rows.norm());
}

TEST(ExpectedPlanRows, WeighTheDwellByTheErrorsOfEndsDrawnOneByOne) {
  UncertainPlan u;
  for (double& t : u.dwell) t = 1.0;
  UncertaintySpec unsure;
  unsure.position = 0.05;
  ExpectedRows expected(u.part, u.geometry, *u.removal, unsure);
  EXPECT_TRUE(expected.changes().empty());
  RandomNumbers random(5);
  std::vector<Stroke> straight = u.laid.strokes;
  for (Stroke& s : straight) s.via = midpoint(s.start, s.finish);
  const Vector meant = u.probed(straight);
  double mean = 0.0;
  constexpr int kDraws = 20;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Stroke> strokes = straight;
    for (std::size_t k = 0; k <= strokes.size(); ++k) {
      const Point beside{0.05 * random.normal(), 0.05 * random.normal()};
      if (k > 0) strokes[k - 1].finish = strokes[k - 1].finish + beside;
      if (k < strokes.size()) strokes[k].start = strokes[k].start + beside;
    }
    for (Stroke& s : strokes) s.via = midpoint(s.start, s.finish);
    mean += (u.probed(strokes) - meant).squaredNorm() / kDraws;
  }
  // Of a tool that is over the part only in part of the path, less than the weight says.
  const double covered = 0.25 * static_cast<double>(u.pixels.size()) / static_cast<double>(u.dwell.size());
  EXPECT_NEAR(covered * expected.beta() * u.dwell.squaredNorm(), mean, 0.25 * mean);
}

struct SampledPlan {
  double expected, expected_plain, in_samples, in_samples_plain, nominal, nominal_plain, share;
};

SampledPlan sampled(test::SmallJob& job, const std::string& uncertainty) {
  job.options.uncertainty = parse_sampled_uncertainty(uncertainty);
  job.options.robust_plan = true;
  const PlannedJob plan = plan_job(job.options);
  EXPECT_TRUE(plan.limits().empty());
  const OutputFolder folder(job.options.out, plan_files());
  const WrittenPlan written = write_plan(plan, folder, {});
  const PlanUncertainty& u = *written.uncertainty;
  return {expected_rms(u.nominal_rms, u.alone),
          expected_rms(u.plain->nominal_rms, u.plain->alone),
          sampled_rms(u.drawn.samples),
          sampled_rms(u.plain->samples),
          u.nominal_rms,
          u.plain->nominal_rms,
          u.plain->weight_share};
}

TEST(RobustPlan, ExpectsNoMoreThanThePlanWithoutIt) {
  for (const char* uncertainty : {"tif-rate=5%,tif-width=2%,position=20um,metrology=0.2nm,samples=60",
                                  "tif-rate=10%,samples=60", "offset=0.2mm,rotation=0.5deg,position=50um,samples=60"}) {
    test::SmallJob job;
    const SampledPlan plan = sampled(job, uncertainty);
    EXPECT_LE(plan.expected, 1.0005 * plan.expected_plain) << uncertainty;
    EXPECT_LE(plan.in_samples, 1.005 * plan.in_samples_plain) << uncertainty;
  }
}

TEST(RobustPlan, ExpectsClearlyLessWhereMuchIsUncertain) {
  test::SmallJob job;
  const SampledPlan plan = sampled(job, "tif-width=12%,offset=0.5mm,position=100um,samples=100");
  EXPECT_LE(plan.expected, 0.97 * plan.expected_plain);
  EXPECT_LE(plan.in_samples, 0.97 * plan.in_samples_plain);
  EXPECT_GE(plan.nominal, plan.nominal_plain);
  EXPECT_EQ(plan.share, 1.0);
}

TEST(RobustPlan, RefusesWhatItCannotHonour) {
  test::SmallJob job;
  job.options.robust_plan = true;
  test::expect_input_error([&] { plan_job(job.options); }, {"`robust plan`", "`uncertainty`"});
  job.options.uncertainty = parse_sampled_uncertainty("metrology=1nm");
  test::expect_input_error([&] { plan_job(job.options); }, {"`robust plan`", "metrology alone"});
  job.options.uncertainty = parse_sampled_uncertainty("tif-rate=5%");
  job.options.objective = {0.5};
  test::expect_input_error([&] { plan_job(job.options); }, {"`robust plan`", "`objective` mixed:0.5"});
  job.options.objective = {};
  job.options.time_price_nm2_per_s = {400.0, GoalKind::TotalAtMost};
  test::expect_input_error([&] { plan_job(job.options); }, {"`robust plan`", "total<=400"});
  job.options.time_price_nm2_per_s = {0.0};
  job.options.solver = SolverKind::Fourier;
  test::expect_input_error([&] { plan_job(job.options); }, {"`robust plan`", "fourier"});
}

}  // namespace
}  // namespace dwell
