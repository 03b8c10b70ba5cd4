/// Plans that learn from the log of an earlier run: on a machine that is slower than its file says, made-up logs of
/// which stand for the controller's.

#include "runs/job/log_lesson.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "runs/job/learnt_files.h"
#include "runs/job/planned_job.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "runs/reports/simulation.h"
#include "tests/runs/logs/made_up_log.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

/// A path that turns at every point, planned for a machine that is faster than the true one.
struct MisjudgedJob : test::SmallJob {
  NamedMachine thought{"thought", {}}, truth{"truth", {}};

  MisjudgedJob() {
    options.path = parse_path_spec("random:pitch=1.2,overrun=2,seed=5");
    options.smoothness = {0.1};
    options.max_feed_mm_per_min = 600.0;
    thought.machine.x.max_acceleration = 80.0;
    thought.machine.y.max_acceleration = 60.0;
    truth = thought;
    truth.machine.x.max_acceleration = 45.0;
    truth.machine.y.max_acceleration = 38.0;
    truth.machine.corner_delay = 0.05;
    options.machine = folder.file("machine.toml", machine_text(thought)).string();
  }

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }

  WrittenPlan plan(const std::string& name) {
    options.out = path(name);
    OutputFolder out(options.out, plan_files());
    const WrittenPlan written = write_plan(plan_job(options), out, {});
    out.commit();
    return written;
  }

  /// What the true machine leaves with the program of a plan [nm].
  double truly_left(const std::string& name) const {
    const Job job = load_job(options);
    const Program program = read_program(path(name) + "/program.nc");
    const Program motion = execute(program, truth.machine).motion;
    const Part& part = *job.part;
    return map_statistics(surface_after(part.map, simulate(motion, part.map, part.kernel, 1)), part.form, 1)
        .rms_about_zero();
  }

  void log_run_of(const std::string& name) {
    const MotionLog log = test::made_up_log(read_program(path(name) + "/program.nc"), truth.machine);
    options.log = folder.file(name + ".csv", test::log_text(log, "t_s,x_mm,y_mm")).string();
    options.log_plan = path(name);
  }
};

TEST(LogLesson, BringsTheNextRunNearThePlan) {
  MisjudgedJob job;
  const double planned = job.plan("first").exact.statistics.rms_about_zero(), first = job.truly_left("first");
  ASSERT_GT(first, 1.5 * planned);  // the machine is misjudged
  job.log_run_of("first");
  const WrittenPlan second = job.plan("second");
  const double left = job.truly_left("second"), said = second.exact.statistics.rms_about_zero();
  EXPECT_LT(left - planned, 0.4 * (first - planned));
  EXPECT_NEAR(said, left, 0.12 * left);  // what is said is of the machine as it is, not of the one in the file
  EXPECT_TRUE(second.limits.empty()) << second.limits.front();

  job.log_run_of("second");
  job.plan("third");
  EXPECT_LT(job.truly_left("third"), 1.02 * left);
  EXPECT_EQ(read_learnt_files(job.path("third"))->logs, 2);
}

TEST(LogLesson, IsInTheSimulationOfThePlan) {
  MisjudgedJob job;
  job.plan("first");
  job.log_run_of("first");
  const WrittenPlan second = job.plan("second");
  SimulationSource source;
  source.plan = job.path("second");
  source.learnt = read_learnt_files(job.path("second"));
  ASSERT_TRUE(source.learnt);
  const Simulation s = simulate_file(job.path("second") + "/program.nc", {}, job.options, {}, false, source);
  EXPECT_NEAR(s.after.statistics.rms, second.exact.statistics.rms, 1e-6 * second.exact.statistics.rms);
  EXPECT_NEAR(s.executed->run_seconds, second.run_seconds, 1e-6 * second.run_seconds);
  EXPECT_EQ(s.executed->logs, 1);
  source.learnt->late.pop_back();
  EXPECT_THROW(simulate_file(job.path("second") + "/program.nc", {}, job.options, {}, false, source), InputError);
}

TEST(LogLesson, RefusesTheLogOfAnotherPathAndAPlanOfAnother) {
  MisjudgedJob job;
  job.plan("first");
  job.log_run_of("first");
  const JobOptions whole = job.options;
  const auto expect_refused = [&](const std::string& words) {
    try {
      plan_job(job.options);
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    job.options = whole;
  };
  job.options.path = parse_path_spec("random:pitch=1.2,overrun=2,seed=6");
  expect_refused("not of the path that is planned");
  job.options.log = job.folder.file("other.csv", "t_s,x_mm,y_mm\n0,0,0\n1,1,1\n2,5,5\n").string();
  expect_refused("no log of this path");
  job.options.machine.clear();
  expect_refused("required a `machine` file");
  job.options.log_plan.clear();
  expect_refused("required `log plan`");
  job.options.log.clear();
  expect_refused("without a `log`");
  job.options.schedule = ScheduleKind::Linear;
  job.options.exports = {"pvt-csv"};
  expect_refused("required `schedule` = constant");
  job.options.log_plan = job.path("nowhere");
  expect_refused("is not the folder of a plan");
  std::ofstream(job.path("first") + "/program.nc", std::ios::app) << "(changed)\n";
  expect_refused("has changed since the plan was made");
}

TEST(LogLesson, StartsAnewOnAnotherMachineFile) {
  MisjudgedJob job;
  job.plan("first");
  job.log_run_of("first");
  job.plan("second");
  job.log_run_of("second");
  job.thought.machine.corner_delay = 0.005;
  job.options.machine = job.folder.file("machine.toml", machine_text(job.thought)).string();
  const WrittenPlan third = job.plan("third");
  EXPECT_EQ(read_learnt_files(job.path("third"))->logs, 1);
  ASSERT_FALSE(third.warnings.empty());
  EXPECT_NE(third.warnings.front().find("beyond another machine"), std::string::npos);
}

TEST(LogLesson, ReadsItsFileBackAndRefusesAnyOther) {
  const std::vector<double> late{0.0, -1.25e-3, 1.0 / 3.0};
  const std::vector<double> back = parse_late_text(late_text({-1, 0, 0}, late), "learnt.csv");
  ASSERT_EQ(back.size(), late.size());
  for (std::size_t i = 0; i < late.size(); ++i) EXPECT_NEAR(back[i], late[i], 1e-9);
  for (const char* wrong : {"1,1,0.1\n", "step,stroke,late_s\n2,1,0.1\n", "step,stroke,late_s\n1,1,nan\n",
                            "step,stroke,late_s\n1,0.1\n", "step,stroke,late_s\n1,1,0.1 ms\n"})
    EXPECT_THROW(parse_late_text(wrong, "learnt.csv"), InputError) << wrong;
}

}  // namespace
}  // namespace dwell
