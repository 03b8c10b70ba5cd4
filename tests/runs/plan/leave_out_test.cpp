#include "runs/plan/leave_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random_numbers.h"
#include "runs/plan/blemish_handling.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

const Grid kMap{90, 120, 0.2, 0.25, {3.0, -1.0}};

/// A hill of waves that a tool of 2.5 mm corrects, noise of 0.1 nm, and a pit.
HeightMap pitted_map(double depth) {
  RandomNumbers random(21);
  HeightMap map(kMap);
  for (Index i = 0; i < kMap.size(); ++i) {
    const Point p = kMap.centre(i);
    const double pit = distance(p, {14.0, 9.0}) < 0.5 ? depth : 0.0;
    map.values[static_cast<std::size_t>(i)] =
        10.0 * std::sin(0.35 * p.x + 0.2) * std::cos(0.3 * p.y) + 0.1 * random.normal() - pit;
  }
  return map;
}

struct Planned {
  Part part;
  LaidPath laid;
  DwellOptions options;
  DwellPlan plan;
};

Planned planned(double depth) {
  Planned p;
  p.part = make_part(pitted_map(depth), gaussian_removal(5.0, 2.5, 4.0), {true, true}, 2);
  p.options.smoothness = {0.01};
  p.options.time_price = {1e-5};
  p.laid = lay_path(p.part, parse_path_spec("raster:pitch=0.8,overrun=2.5"), Motion::Moving, 50.0);
  p.plan = find_dwell(p.part, p.laid, p.options);
  return p;
}

double rms_without_pit(const HeightMap& surface) {
  HeightMap map = surface;
  for (Index i = 0; i < kMap.size(); ++i) {
    if (distance(kMap.centre(i), {14.0, 9.0}) < 0.5) map.values[static_cast<std::size_t>(i)] = std::nan("");
  }
  return map_statistics(map, {true, true}).rms;
}

TEST(LeaveOut, DoesAwayWithWhatTheFitMakesAroundABlemish) {
  const Planned p = planned(60.0);
  const DwellPlan left_out = leave_out_blemishes(p.part, p.laid, p.plan, p.options);
  ASSERT_TRUE(left_out.left_out);
  EXPECT_EQ(left_out.left_out->blemishes, 1);
  EXPECT_NEAR(static_cast<double>(left_out.left_out->pixels.size()), 3.1416 * 0.25 / 0.05, 4.0);
  // Nothing is hidden: the pit stands where it was, and the figure of all pixels holds it.
  EXPECT_GT(left_out.exact.statistics.rms, p.plan.exact.statistics.rms);
  EXPECT_EQ(left_out.exact.statistics.valid_pixels, kMap.size());
  EXPECT_NEAR(left_out.residual.rms, left_out.exact.statistics.rms, 0.01 * left_out.residual.rms);
  const double before = rms_without_pit(p.plan.exact.surface), after = rms_without_pit(left_out.exact.surface);
  EXPECT_LT(after, 0.6 * before);
  EXPECT_NEAR(left_out.left_out->rms_before_without, before, 1e-6);
  EXPECT_NEAR(left_out.left_out->rms_before, p.plan.exact.statistics.rms, 1e-9);
  EXPECT_NEAR(left_out.left_out->fit_rms, after, 0.02 * after);
}

// Weight 0: what a pixel left out holds has no influence on the dwell.
TEST(LeaveOut, GivesTheDwellOfASurfaceWithoutThePixels) {
  const Planned p = planned(60.0);
  const DwellPlan left_out = leave_out_blemishes(p.part, p.laid, p.plan, p.options);
  HeightMap map = pitted_map(0.0);
  for (const Index i : left_out.left_out->pixels) map.values[static_cast<std::size_t>(i)] = std::nan("");
  const Part part = make_part(map, gaussian_removal(5.0, 2.5, 4.0), {true, true}, 2);
  const DwellPlan other = find_dwell(part, p.laid, p.options);
  EXPECT_LT((left_out.seconds - other.seconds).norm(), 1e-9 * other.seconds.norm());
}

TEST(LeaveOut, ChangesNothingWithoutBlemishes) {
  const Planned p = planned(0.0);
  const DwellPlan same = leave_out_blemishes(p.part, p.laid, p.plan, p.options);
  ASSERT_TRUE(same.left_out);
  EXPECT_TRUE(same.left_out->pixels.empty());
  EXPECT_EQ(same.seconds, p.plan.seconds);
  EXPECT_EQ(same.exact.statistics.rms, p.plan.exact.statistics.rms);
}

TEST(BlemishHandling, HasWordsThatReadBack) {
  for (const BlemishHandling h : {BlemishHandling::Report, BlemishHandling::LeaveOut, BlemishHandling::Keep})
    EXPECT_EQ(parse_blemish_handling(to_string(h)), h);
  test::expect_input_error([] { parse_blemish_handling("hide"); }, {"'hide'", "report, leave-out, keep"});
}

}  // namespace
}  // namespace dwell
