#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/spec_text.h"
#include "core/form/map_statistics.h"
#include "core/map/map_crop.h"
#include "core/removal/simulate.h"
#include "core/tif/models/removal_models.h"
#include "paths/feed/plan_program.h"
#include "paths/path_catalogue.h"
#include "runs/example/example.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_program.h"
#include "runs/plan/part.h"

namespace dwell {
namespace {

constexpr FormTerms kPistonAndTilt{true, true};

/// The middle 100 x 100 mm of the generator's mirror of 120 mm, scaled to the PV of 2.07 um that the paper begins with:
/// without the fallen edge, to which a pad centred on cells of the part does nothing.
HeightMap xie_surface() {
  ExampleOptions options;
  options.shape = ExampleOptions::Shape::Rectangle;
  options.width = options.height = 120.0;
  options.pitch = 1.0;
  HeightMap map = crop(example_mirror(options), {-50.0, -50.0}, {50.0, 50.0});
  const double scale = 2070.0 / map_statistics(map, kPistonAndTilt).pv;
  for (double& height : map.values) height *= scale;
  return map;
}

struct XieRun {
  double pv = 0.0, rms = 0.0;  // left [nm]
  double minutes = 0.0;        // of dwell
  Index cells = 0;             // that the path goes through
};

/// The paper's three runs, each on what the one before left: a raster over all cells of 10 mm, then twice the
/// nearest-neighbour path over the cells whose mean is at least 10 nm. `most` [s] bounds the dwell of each.
std::vector<XieRun> xie_runs(DwellOptions options, const std::vector<std::optional<double>>& most) {
  HeightMap surface = xie_surface();
  const RemovalFunction tool =
      removal_of_spec(parse_spec_text("planetary:peak=20,radius=6.25,eccentricity=0.8", "tif"));
  std::vector<XieRun> runs;
  for (const auto& seconds : most) {
    const char* const path = runs.empty() ? "raster:pitch=10,overrun=0,step=10" : "nearest:cell=10,critical=10";
    if (seconds) options.time_price = {*seconds, GoalKind::TotalAtMost};
    const Part part = make_part(surface, tool, kPistonAndTilt, 1);
    const LaidPath laid = lay_path(part, parse_path_spec(path), Motion::Moving, options.machine.feed_limits().max_feed);
    const DwellPlan dwell = find_dwell(part, laid, options);
    const MachineProgram program = make_machine_program(laid, dwell, options.machine);
    surface = surface_after(surface, simulate(program_of(program.table), surface, part.kernel, 1));
    const MapStatistics left = map_statistics(surface, kPistonAndTilt);
    runs.push_back({left.pv, left.rms, dwell.seconds.sum() / 60.0, laid.metrics.points});
  }
  return runs;
}

void expect_runs(const std::vector<XieRun>& runs, const std::vector<XieRun>& documented) {
  ASSERT_EQ(runs.size(), documented.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    EXPECT_NEAR(runs[k].pv, documented[k].pv, 0.01 * documented[k].pv) << k;
    EXPECT_NEAR(runs[k].rms, documented[k].rms, 0.01 * documented[k].rms) << k;
    EXPECT_NEAR(runs[k].minutes, documented[k].minutes, 0.2) << k;
    EXPECT_EQ(runs[k].cells, documented[k].cells) << k;
  }
}

/// docs/papers.md, "S1 three runs".
TEST(XieRuns, LeaveWhatTheTableBesideThePaperSays) {
  // As the paper does it: the least dwell everywhere is its one feed.
  DwellOptions one_feed;
  one_feed.machine.max_feed_mm_per_min = 50.0;
  one_feed.smoothness = {0.0};
  one_feed.time_price = {1e9};
  const std::vector<XieRun> at_one_feed = xie_runs(one_feed, {{}, {}, {}});
  expect_runs(at_one_feed, {{1979, 284.0, 20.0, 100}, {1648, 203.1, 10.7, 54}, {1573, 166.7, 9.9, 49}});
  // With dwell times, in the time that each run of the paper took.
  DwellOptions planned;
  planned.machine.max_feed_mm_per_min = 3000.0;
  const std::vector<XieRun> with_dwell = xie_runs(planned, {864.0, 750.0, 720.0});
  expect_runs(with_dwell, {{1165, 148.8, 14.4, 100}, {1041, 119.9, 10.8, 65}, {1046, 116.2, 2.5, 45}});
  EXPECT_LT(with_dwell.front().rms, at_one_feed.back().rms);  // one run with dwell does more than three without
}

}  // namespace
}  // namespace dwell
