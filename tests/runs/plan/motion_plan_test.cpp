/// A plan for a machine: within what it can do, and with the motion that it makes left out of no figure.

#include "runs/plan/motion_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "runs/job/planned_job.h"
#include "runs/machine/machine_file.h"
#include "runs/plan/least_dwell_of.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "runs/reports/simulation.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

/// A path that turns at every point, on a machine with weak drives, the one along y weaker.
struct TurningJob : test::SmallJob {
  TurningJob() {
    options.path = parse_path_spec("random:pitch=1.2,overrun=2,seed=5");
    options.smoothness = {0.1};
    options.max_feed_mm_per_min = 600.0;
    NamedMachine slow{"slow", {}};
    slow.machine.x.max_acceleration = 60.0;
    slow.machine.y.max_acceleration = 40.0;
    slow.machine.path_acceleration = 50.0;
    slow.machine.corner_delay = 0.003;
    options.machine = folder.file("machine.toml", machine_text(slow)).string();
  }
};

double rms_of_motion(const PlannedJob& plan, const Program& program) {
  const Execution run = execute(program, plan.job.machine->machine);
  const HeightMap left = surface_after(
      plan.part().map, simulate(run.motion, plan.part().map, plan.dwell.lattice.kernel, plan.part().threads));
  return map_statistics(left, plan.part().form, plan.part().threads).rms_about_zero();
}

TEST(MotionPlan, LeavesWhatThePlanSaysWhenTheMachineExecutesIt) {
  const TurningJob job;
  const PlannedJob plan = plan_job(job.options);
  ASSERT_TRUE(plan.dwell.motion);
  const MotionPlan& motion = *plan.dwell.motion;
  const double planned = plan.dwell.residual.rms_about_zero();
  EXPECT_LE(motion.executed(), 1.05 * planned);
  EXPECT_LE(motion.executed(), motion.one_shot());
  // The program as exported, executed, and one whose feeds know nothing of the machine.
  EXPECT_NEAR(rms_of_motion(plan, program_of(plan.program.table)), motion.executed(), 1e-3 * motion.executed());
  JobOptions without = job.options;
  without.machine.clear();
  PlannedJob naive = plan_job(without);
  naive.job.machine = plan.job.machine;
  EXPECT_GT(rms_of_motion(naive, program_of(naive.program.table)), 2.0 * motion.executed());
}

TEST(MotionPlan, KeepsEveryStrokeWithinWhatTheMachineCan) {
  const TurningJob job;
  const PlannedJob plan = plan_job(job.options);
  const Eigen::VectorXd least = least_dwell_of(plan.laid, dwell_options(plan.job).machine);
  EXPECT_GE((plan.dwell.seconds - least).minCoeff(), -1e-12);
  const Eigen::VectorXd by_feed = minimum_dwell(plan.laid.strokes, dwell_options(plan.job).machine.feed_limits());
  EXPECT_GT(least.sum(), 1.5 * by_feed.sum());  // corners cost
  EXPECT_GT(plan.dwell.motion->at_least, 0);
}

TEST(MotionPlan, NoRoundsLeaveTheFeedsForTheSolversDwell) {
  TurningJob job;
  job.options.rounds = 0;
  const PlannedJob plan = plan_job(job.options);
  EXPECT_EQ(plan.dwell.motion->rounds.size(), 1U);
  EXPECT_EQ(plan.dwell.motion->best, 0);
}

/// What the motion removes on its own asks for another total in each round, unless one is to be held.
TEST(MotionPlan, HoldsATotalThroughAllRounds) {
  TurningJob job;
  const double free = plan_job(job.options).dwell.seconds.sum();
  for (const double share : {0.97, 0.9}) {
    job.options.time_price_nm2_per_s = {share * free, GoalKind::TotalAtMost};
    const PlannedJob plan = plan_job(job.options);
    const double taken = plan.dwell.motion->seconds.sum();
    EXPECT_LE(taken, 1.003 * share * free) << share;
    EXPECT_TRUE(plan.limits().empty()) << plan.limits().front();
  }
}

TEST(MotionPlan, IsStatedByTheMotionOfTheProgramOnDisk) {
  const TurningJob job;
  const PlannedJob plan = plan_job(job.options);
  OutputFolder folder(job.options.out, plan_files());
  const WrittenPlan written = write_plan(plan, folder, {});
  EXPECT_TRUE(written.limits.empty()) << written.limits.front();
  EXPECT_NEAR(written.exact.lattice_rms, plan.dwell.motion->executed(), 2e-3 * plan.dwell.motion->executed());
  const Simulation s = simulate_file(folder.path("program.nc"), {}, job.options, {});
  ASSERT_TRUE(s.executed);
  EXPECT_NEAR(s.after.statistics.rms, written.exact.statistics.rms, 1e-9);
  EXPECT_GT(s.executed->commanded.residual.rms, 1.5 * s.after.statistics.rms);  // made for the machine, not without it
}

/// The tool settles in the first stroke after each lift, which that stroke's feed makes up for; lifting and lowering
/// are time alone.
TEST(MotionPlan, CountsTheRestsAtLifts) {
  TurningJob job;
  job.options.path = parse_path_spec("raster:pitch=1.2,overrun=1");
  job.options.keep_out = "circle:3,6,2";
  job.options.exports = {"pvt-csv"};
  const PlannedJob plain = plan_job(job.options);
  NamedMachine machine = read_machine_file(job.options.machine);
  machine.machine.lift = {0.5, 0.25, 0.04};
  job.options.machine = job.folder.file("lifting.toml", machine_text(machine)).string();
  const PlannedJob plan = plan_job(job.options);
  const auto plunges = static_cast<double>(plan.laid.metrics.lifts + 1);
  ASSERT_GT(plunges, 2.0);
  EXPECT_NEAR(plan.dwell.motion->executed(), plain.dwell.motion->executed(), 0.02 * plain.dwell.motion->executed());
  const Eigen::VectorXd least = least_dwell_of(plan.laid, dwell_options(plan.job).machine),
                        plain_least = least_dwell_of(plain.laid, dwell_options(plain.job).machine);
  EXPECT_NEAR(least.sum() - plain_least.sum(), 0.04 * plunges, 1e-9);
  OutputFolder folder(job.options.out, plan_files());
  const WrittenPlan written = write_plan(plan, folder, {});
  EXPECT_TRUE(written.limits.empty()) << written.limits.front();
  EXPECT_NEAR(written.travel.rests.lift, 0.5 * (plunges - 1.0), 1e-9);
  EXPECT_NEAR(written.travel.rests.plunge, 0.25 * plunges, 1e-9);
  EXPECT_NEAR(written.exact.lattice_rms, plan.dwell.motion->executed(), 2e-3 * plan.dwell.motion->executed());
  const Simulation s = simulate_file(folder.path("program.nc"), {}, job.options, {});
  EXPECT_NEAR(s.after.statistics.rms, written.exact.statistics.rms, 1e-9);
  EXPECT_NEAR(s.executed->run_seconds, written.run_seconds, 1e-6);
  EXPECT_NEAR(s.executed->lifts.settle, 0.04 * plunges, 1e-9);
  // The table of positions, velocities and times has no settling; the machine makes it.
  const Simulation table = simulate_file(folder.path("pvt.csv"), {}, job.options, {});
  EXPECT_NEAR(table.after.statistics.rms, written.exact.statistics.rms, 2e-3 * written.exact.statistics.rms);
  EXPECT_NEAR(table.executed->run_seconds - table.executed->commanded.run_seconds,
              0.5 * (plunges - 1.0) + 0.29 * plunges, 1e-6);
}

double least_seconds(const Program& program, const Machine& machine) {
  const Execution run = execute(program, machine);
  double least = 1e9;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    if (program.steps[i].removes) least = std::min(least, run.seconds[i]);
  }
  return least;
}

/// Strokes that are shorter than the controller's blocks are merged, as far as they are straight on, and the plan is
/// made again; what is still short is run slowly enough.
TEST(MotionPlan, KeepsTheBlockRate) {
  for (const ScheduleKind kind : {ScheduleKind::Constant, ScheduleKind::Linear}) {
    TurningJob job;
    job.options.path = parse_path_spec("raster:pitch=1.2,step=0.3,overrun=2");
    job.options.schedule = kind;
    if (kind != ScheduleKind::Constant) job.options.exports = {"pvt-csv"};
    const PlannedJob plain = plan_job(job.options);
    EXPECT_FALSE(plain.blocks);
    NamedMachine machine = read_machine_file(job.options.machine);
    machine.machine.controller.max_blocks_per_s = 12.0;
    job.options.machine = job.folder.file("blocks.toml", machine_text(machine)).string();
    const PlannedJob plan = plan_job(job.options);
    ASSERT_TRUE(plan.blocks);
    EXPECT_GT(plan.blocks->short_before, 20U);
    EXPECT_LT(plan.blocks->after, plan.blocks->before);
    EXPECT_LE(plan.dwell.motion->executed(), 1.3 * plain.dwell.motion->executed()) << to_string(kind);
    OutputFolder folder(job.options.out, plan_files());
    const WrittenPlan written = write_plan(plan, folder, {});
    EXPECT_TRUE(written.limits.empty()) << to_string(kind) << ": " << written.limits.front();
    const std::string file = kind == ScheduleKind::Constant ? "program.nc" : "pvt.csv";
    EXPECT_GE(least_seconds(read_program(folder.path(file)), machine.machine), 1.0 / 12.0 * (1.0 - 1e-5));
    // What was planned without the rate is beyond it, and says so.
    OutputFolder other((job.folder.path() / "other").string(), plan_files());
    write_plan(plain, other, {});
    const Simulation s = simulate_file(other.path(file), {}, job.options, {});
    ASSERT_FALSE(s.limits.empty());
    EXPECT_NE(s.limits.front().find("shorter than the 83.33 ms that the controller takes for a block"),
              std::string::npos)
        << s.limits.front();
  }
}

/// The program is in the controller's steps, keeps the limits, and its effect is said where it matters.
TEST(MotionPlan, KeepsTheStepsOfTheController) {
  for (const ScheduleKind kind : {ScheduleKind::Constant, ScheduleKind::Linear, ScheduleKind::Pvt}) {
    TurningJob job;
    job.options.path = parse_path_spec("raster:pitch=1.2,overrun=2");
    job.options.schedule = kind;
    job.options.exports = {"pvt-csv"};
    NamedMachine machine = read_machine_file(job.options.machine);
    machine.machine.controller.time_resolution = 0.002;
    machine.machine.controller.position_resolution = 0.0005;
    machine.machine.letters = {'U', 'V'};
    job.options.machine = job.folder.file("steps.toml", machine_text(machine)).string();
    const PlannedJob plan = plan_job(job.options);
    OutputFolder folder(job.options.out, plan_files());
    const WrittenPlan written = write_plan(plan, folder, {});
    EXPECT_TRUE(written.limits.empty()) << to_string(kind) << ": " << written.limits.front();
    EXPECT_LE(written.exact.lattice_rms, 1.1 * plan.dwell.residual.rms_about_zero()) << to_string(kind);
    for (const ProgramStep& step : read_program(folder.path("pvt.csv")).steps)
      EXPECT_NEAR(step.seconds / 0.002, std::round(step.seconds / 0.002), 1e-6);
    const Simulation s = simulate_file(folder.path(written.program.file), {}, job.options, {});
    EXPECT_NEAR(s.after.statistics.rms, written.exact.statistics.rms, 1e-9) << to_string(kind);
  }
}

/// Schedules of speeds: what the file says is what the machine does, and feeds alone are not written.
TEST(MotionPlan, SaysSpeedsInAFileThatLeavesWhatThePlanSays) {
  for (const ScheduleKind kind : {ScheduleKind::Linear, ScheduleKind::Pvt}) {
    TurningJob job;
    job.options.schedule = kind;
    job.options.exports = {"pvt-csv"};
    if (kind == ScheduleKind::Linear) job.options.exports = {"pvt-csv", "g293", "flin"};
    const PlannedJob plan = plan_job(job.options);
    ASSERT_TRUE(plan.dwell.motion && plan.dwell.motion->program) << to_string(kind);
    EXPECT_LE(plan.dwell.motion->executed(), 1.05 * plan.dwell.residual.rms_about_zero()) << to_string(kind);
    OutputFolder folder(job.options.out, plan_files());
    const WrittenPlan written = write_plan(plan, folder, {});
    EXPECT_TRUE(written.limits.empty()) << to_string(kind) << ": " << written.limits.front();
    EXPECT_EQ(written.program.file, "pvt.csv");
    EXPECT_FALSE(written.table_has_same_steps);
    EXPECT_FALSE(std::filesystem::exists(folder.path("program.nc")));
    EXPECT_FALSE(std::filesystem::exists(folder.path("feed.csv")));
    EXPECT_NEAR(written.exact.lattice_rms, plan.dwell.motion->executed(), 1e-3 * plan.dwell.motion->executed());
    const Simulation s = simulate_file(folder.path("pvt.csv"), {}, job.options, {});
    EXPECT_NEAR(s.after.statistics.rms, written.exact.statistics.rms, 1e-9) << to_string(kind);
    ASSERT_EQ(written.exports.size(), job.options.exports.size());
    for (const WrittenExport& one : written.exports) {  // within a block FLIN is not constant acceleration
      const double left = written.exact.statistics.rms_about_zero();
      EXPECT_NEAR(one.residual.rms_about_zero(), left, (one.word == "flin" ? 1e-2 : 1e-4) * left) << one.word;
    }
  }
}

}  // namespace
}  // namespace dwell
