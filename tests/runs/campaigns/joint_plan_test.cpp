/// A plan for several tools, by the files that it writes.

#include "runs/campaigns/joint_plan.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/removal/removal_probe.h"
#include "core/removal/simulate.h"
#include "runs/campaigns/joint_plan_output.h"
#include "runs/job/input_files.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/recorded_plan.h"
#include "runs/reports/simulation.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

constexpr const char* kSmall = "small;tif=gaussian:peak=4,fwhm=1.6,radius=2.5;path=raster:pitch=0.8,overrun=1,angle=90";
constexpr const char* kLarge = "large;tif=gaussian:peak=10,fwhm=5,radius=7;path=raster:pitch=2,overrun=3";

/// The small map with waves that only the small tool takes, two tools, the small one named first.
struct TwoToolJob : test::SmallJob {
  HeightMap map = test::small_map();

  TwoToolJob() {
    for (Index i = 0; i < map.grid.size(); ++i)
      map.values[static_cast<std::size_t>(i)] += 4.0 * std::sin(1.5 * map.grid.centre(i).x);
    write_map(options.map, map);
    options.tif.clear();
    options.path = {};
    options.smoothness = {0.0, GoalKind::Auto};
    options.time_price_nm2_per_s = {1e-3};
    options.tools = std::string(kSmall) + ";change-over=5s\n" + kLarge;
  }

  std::string file(const std::string& name) const { return (folder.path() / "plan" / name).string(); }

  JointPlan plan() const {
    OutputFolder out(options.out, joint_plan_files());
    JointPlan made = plan_tools(options, out, {});
    write_joint_plan(made, out);
    out.commit();
    return made;
  }

  /// What a folder's program leaves of a surface, from the removal function itself, at every pixel.
  HeightMap left_of(HeightMap surface, const std::string& name, const RemovalFunction& tif) const {
    const RemovingSteps steps = removing_steps(read_program(file(name + "/program.nc")));
    const Part part = make_part(surface, tif, {}, 1);
    const RemovalProbe probe(surface.grid, part.exact, steps.strokes, steps.seconds);
    for (Index i = 0; i < surface.grid.size(); ++i) {
      double& z = surface.values[static_cast<std::size_t>(i)];
      if (std::isfinite(z)) z -= probe.mean_over_pixel(surface.grid.centre(i));
    }
    return surface;
  }
};

TEST(JointPlan, LeavesWhatAllItsProgramsTogetherLeave) {
  const TwoToolJob job;
  const JointPlan plan = job.plan();
  EXPECT_TRUE(plan.limits.empty()) << plan.limits.front();
  ASSERT_EQ(plan.runs.size(), 2u);
  EXPECT_EQ(plan.runs[0].folder, "1-large");  // wide tools first, however they are given
  EXPECT_EQ(plan.runs[1].folder, "2-small");
  const HeightMap first = job.left_of(job.map, "1-large", gaussian_removal(10.0, 5.0, 7.0));
  const HeightMap last = job.left_of(first, "2-small", gaussian_removal(4.0, 1.6, 2.5));
  EXPECT_NEAR(plan.runs[0].left.rms, map_statistics(first, {true, true}).rms, 1e-3 * plan.runs[0].left.rms);
  EXPECT_NEAR(plan.runs[1].left.rms, map_statistics(last, {true, true}).rms, 5e-3 * plan.runs[1].left.rms);
  EXPECT_EQ(plan.runs[1].before.rms, plan.runs[0].left.rms);
  EXPECT_NEAR(plan.runs[0].before.rms, map_statistics(job.map, {true, true}).rms, 1e-9);
  // As good as the joint solve has it: what the first program leaves is what it was to leave.
  EXPECT_NEAR(plan.runs[1].left.rms, plan.choice.dwell.residual_rms, 0.03 * plan.choice.dwell.residual_rms);
  EXPECT_NEAR(plan.runs[0].dwell + plan.runs[1].dwell, plan.choice.set().seconds, 0.01 * plan.choice.set().seconds);
  EXPECT_LT(plan.runs[1].left.rms, 0.1 * plan.runs[0].left.rms);
  EXPECT_EQ(plan.change_over(), 5.0);
}

TEST(JointPlan, HasPlansThatAreAsAnyOther) {
  const TwoToolJob job;
  const JointPlan plan = job.plan();
  for (const ToolRun& run : plan.runs) {
    const RecordedPlan recorded = read_recorded_plan(job.file(run.folder));
    EXPECT_NO_THROW(check_recorded_inputs(recorded, {}));
    EXPECT_EQ(recorded.options.map, job.file(run.folder + "/surface.npy"));
    EXPECT_TRUE(recorded.options.tools.empty());
    const Simulation again =
        simulate_file(recorded.program(), {}, recorded.options, {}, false, {job.file(run.folder), {}, {}, {}});
    EXPECT_TRUE(again.differences.empty()) << again.differences.front();
    const auto summary = nlohmann::json::parse(read_whole_file(job.file(run.folder + "/summary.json")));
    const double stated = summary["program"]["residual_rms_nm"].get<double>();
    EXPECT_NEAR(again.after.statistics.rms, stated, 1e-6 * stated);
  }
  // The last one's is of the whole: a surface that is there, and not one less what is to come.
  EXPECT_TRUE(is_result(job.file(""), joint_plan_files()));
}

TEST(JointPlan, GoesWithoutAToolThatDoesNotPay) {
  TwoToolJob job;
  job.options.tools = std::string(kSmall) + ";change-over=1000h\n" + kLarge;
  const JointPlan plan = job.plan();
  ASSERT_EQ(plan.runs.size(), 1u);
  EXPECT_EQ(plan.runs[0].folder, "1-large");
  EXPECT_FALSE(std::filesystem::exists(job.file("2-small")));
  const std::string text = joint_plan_text(plan);
  EXPECT_NE(text.find("small does not pay: with it"), std::string::npos) << text;
  EXPECT_NE(text.find("large pays"), std::string::npos) << text;
}

/// The small tool's program knows what the machine makes of the large one's.
TEST(JointPlan, LetsLaterToolsTakeUpWhatAMachineMakesOfEarlierPrograms) {
  TwoToolJob job;
  const std::string machine = job.folder.file("machine.toml", machine_text(example_machine())).string();
  job.options.tools = std::string(kSmall) + "\n" + kLarge + ";machine=" + machine + ";rounds=0";
  const JointPlan plan = job.plan();
  ASSERT_EQ(plan.runs.size(), 2u);
  EXPECT_LT(plan.runs[1].left.rms, 1.2 * plan.choice.dwell.residual_rms);
}

TEST(JointPlan, JudgesTheSurfaceAfterAllPrograms) {
  TwoToolJob job;
  job.options.accept = "rms<=1pm";
  const JointPlan plan = job.plan();
  ASSERT_EQ(plan.acceptance.size(), 1u);
  EXPECT_NEAR(*plan.acceptance[0].value, plan.runs.back().left.rms, 1e-6 * plan.runs.back().left.rms);
  ASSERT_EQ(plan.limits.size(), 1u);
  EXPECT_NE(plan.limits[0].find("2-small: "), std::string::npos) << plan.limits[0];
}

TEST(JointPlan, CountsTheClearApertureAlone) {
  TwoToolJob job;
  job.options.clear_aperture = parse_aperture("rect:-2,3,7,10");
  const JointPlan plan = job.plan();
  const HeightMap surface = read_map(job.file("2-small/surface.npy"));
  Index counted = 0, measured = 0;
  for (const double z : surface.values) measured += std::isfinite(z) ? 1 : 0;
  for (const double z : plan.job.part->map.values) counted += std::isfinite(z) ? 1 : 0;
  EXPECT_EQ(measured, job.map.valid_pixels());  // all of it is worked on and shown
  EXPECT_LT(counted, measured);
  EXPECT_EQ(plan.runs[1].left.valid_pixels, counted);
  const RecordedPlan recorded = read_recorded_plan(job.file("2-small"));
  const Simulation again =
      simulate_file(recorded.program(), {}, recorded.options, {}, false, {job.file("2-small"), {}, {}, {}});
  EXPECT_NEAR(again.after.statistics.rms, plan.runs[1].left.rms, 1e-6 * plan.runs[1].left.rms);
}

TEST(JointPlan, RefusesWhatIsForOnePlan) {
  TwoToolJob job;
  const auto refused = [&job](std::initializer_list<std::string> words) {
    test::expect_input_error([&] { job.plan(); }, words);
    EXPECT_FALSE(std::filesystem::exists(job.options.out));
  };
  const JobOptions good = job.options;
  job.options.blemishes = BlemishHandling::LeaveOut;
  refused({"`blemishes` = leave-out", "`tool`"});
  job.options = good;
  job.options.certify = 0.01;
  refused({"`certify`", "`tool`"});
  job.options = good;
  job.options.tools = std::string(kSmall) + "\nother;tif=gaussian:peak=1,fwhm=3,radius=5";
  refused({"tool 'other'", "path", "required"});
  job.options.tools = std::string(kSmall) + "\nother;tif=none.csv;path=raster:pitch=1";
  refused({"tool 'other'", "none.csv"});
}

}  // namespace
}  // namespace dwell
