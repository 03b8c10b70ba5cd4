/// The rest of a program that was stopped: what both parts remove together is what the whole removes.

#include "runs/reports/resume_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "runs/reports/recorded_plan.h"
#include "runs/reports/simulation.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/logs/made_up_log.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// A plan on disk, and the rest of its program wherever it is stopped.
struct StoppedJob : test::SmallJob {
  WrittenPlan whole;

  void plan() {
    OutputFolder out(options.out, plan_files());
    whole = write_plan(plan_job(options), out, {});
    out.commit();
  }

  std::string file(const std::string& name) const { return (folder.path() / name).string(); }
  GcodeSteps steps() const { return read_gcode_steps(read_whole_file(file("plan/program.nc")), "program.nc", {}); }
  std::string line_of_step(std::size_t step) const { return fmt::format("{}", steps().lines[step]); }

  JobOptions rest_options() const {
    JobOptions rest = read_recorded_plan(file("plan")).options;
    rest.log_plan = file("plan");
    rest.out = file("rest");
    return rest;
  }

  WrittenPlan resume(const std::string& stop) const { return resume(stop, rest_options()); }
  WrittenPlan resume(const std::string& stop, const JobOptions& rest) const {
    OutputFolder out(rest.out, plan_files());
    const WrittenPlan written = write_plan(resume_plan(stop, rest, out, {}), out, {});
    out.commit();
    return written;
  }

  void expect_refused(const std::string& stop, std::initializer_list<std::string> words) const {
    const JobOptions rest = rest_options();
    expect_input_error([&] { resume_plan(stop, rest, OutputFolder(rest.out, plan_files()), {}); }, words);
  }

  /// What a program removes of the part as its job's machine runs it [nm].
  HeightMap removal_of(const Program& program) const {
    const Job job = load_job(options);
    const Program motion = job.machine ? execute(program, job.machine->machine).motion : program;
    return simulate(motion, job.part->map, job.part->kernel, 1);
  }

  /// What both parts remove less what the whole program removes: largest deviation, as a share of the largest removal.
  double deviation() const {
    const Job job = load_job(options);
    const HeightMap remaining = read_map(file("rest/remaining.npy"));
    const HeightMap rest = removal_of(read_program(file("rest/program.nc")));
    const HeightMap all = removal_of(read_program(file("plan/program.nc")));
    double most = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < all.values.size(); ++i) {
      if (!std::isfinite(all.values[i])) continue;
      const double both = job.part->map.values[i] - remaining.values[i] + rest.values[i];
      most = std::max(most, std::abs(both - all.values[i]));
      largest = std::max(largest, all.values[i]);
    }
    return most / largest;
  }
};

/// The first step after the middle that goes straight on from the one before.
std::size_t straight_step(const Program& program, bool straight = true) {
  for (std::size_t i = program.steps.size() / 2; i + 1 < program.steps.size(); ++i) {
    const auto direction = [&](std::size_t k) {
      const Point way = program.steps[k].finish - program.steps[k].start;
      return (1.0 / length(way)) * way;
    };
    if (program.steps[i].removes && program.steps[i - 1].removes &&
        (length(direction(i) - direction(i - 1)) < 1e-6 && length(direction(i + 1) - direction(i)) < 1e-6) == straight)
      return i;
  }
  return 0;
}

nlohmann::json resume_block_of(const WrittenPlan& written) { return nlohmann::json::parse(written.summary)["resume"]; }

TEST(ResumePlan, BothPartsRemoveWhatTheWholeProgramRemoves) {
  StoppedJob job;
  job.plan();
  const Program program = job.steps().program;
  const std::size_t stop = straight_step(program);
  ASSERT_GT(stop, 0u);
  const WrittenPlan rest = job.resume(job.line_of_step(stop));
  EXPECT_TRUE(rest.limits.empty()) << rest.limits.front();
  EXPECT_LT(job.deviation(), 1e-6);
  // The rest is predicted to leave what the whole program was predicted to leave.
  EXPECT_NEAR(rest.exact.statistics.rms, job.whole.exact.statistics.rms, 5e-3 * job.whole.exact.statistics.rms);
  const nlohmann::json block = resume_block_of(rest);
  EXPECT_EQ(block["step"], stop + 1);
  EXPECT_EQ(block["steps"], program.steps.size());
  double seconds = 0.0;
  for (std::size_t i = 0; i < stop; ++i) seconds += program.steps[i].removes ? program.steps[i].seconds : 0.0;
  EXPECT_NEAR(block["run_s"].get<double>(), seconds, 1e-9 * seconds);
  EXPECT_NEAR(block["block_s"].get<double>(), program.steps[stop].seconds, 1e-12);
  EXPECT_GT(block["block_depth_nm"].get<double>(), 0.0);
  ASSERT_FALSE(rest.warnings.empty());
  EXPECT_NE(rest.warnings[0].find("uncertain by a block"), std::string::npos) << rest.warnings[0];
  // The tool begins lifted, comes down at the stop, and has no other way than the rest.
  const Program read = read_program(job.file("rest/program.nc"));
  EXPECT_NEAR(distance(read.steps.front().start, program.steps[stop].start), 0.0, 2e-6);
  EXPECT_EQ(read.steps.size(), program.steps.size() - stop + 1);  // and the way down
}

TEST(ResumePlan, IsAPlanLikeAnyOther) {
  StoppedJob job;
  job.plan();
  const WrittenPlan rest = job.resume(job.line_of_step(straight_step(job.steps().program)));
  const RecordedPlan recorded = read_recorded_plan(job.file("rest"));
  EXPECT_NO_THROW(check_recorded_inputs(recorded, {}));
  EXPECT_EQ(recorded.options.map, job.file("rest/remaining.npy"));
  const Simulation again =
      simulate_file(recorded.program(), {}, recorded.options, {}, false, {job.file("rest"), {}, {}, {}});
  EXPECT_TRUE(again.differences.empty()) << again.differences.front();
  EXPECT_NEAR(again.after.statistics.rms, rest.exact.statistics.rms, 1e-6 * rest.exact.statistics.rms);
  // And is resumed in its turn.
  JobOptions next = recorded.options;
  next.log_plan = job.file("rest");
  next.out = job.file("last");
  const GcodeSteps steps = read_gcode_steps(read_whole_file(job.file("rest/program.nc")), "program.nc", {});
  const WrittenPlan last = job.resume(fmt::format("{}", steps.lines[straight_step(steps.program)]), next);
  EXPECT_NEAR(last.exact.statistics.rms, job.whole.exact.statistics.rms, 5e-3 * job.whole.exact.statistics.rms);
}

TEST(ResumePlan, KeepsTheStrokesAtCornersAndWithinThem) {
  for (const char* path : {"raster:pitch=1,overrun=2", "random:pitch=1,overrun=2,seed=5"}) {
    StoppedJob job;
    job.options.path = parse_path_spec(path);
    job.plan();
    const std::size_t corner = straight_step(job.steps().program, false);
    for (const std::size_t stop : {corner, corner + 1, corner + 2}) {
      SCOPED_TRACE(fmt::format("{} step {}", path, stop));
      const WrittenPlan rest = job.resume(job.line_of_step(stop));
      EXPECT_LT(job.deviation(), 3e-4);  // on another lattice
      EXPECT_NEAR(rest.exact.statistics.rms, job.whole.exact.statistics.rms, 5e-3 * job.whole.exact.statistics.rms);
    }
  }
}

TEST(ResumePlan, FindsBlocksByTheirNumbers) {
  StoppedJob job;
  job.options.block_numbers = 10;
  job.plan();
  const GcodeSteps steps = job.steps();
  const std::size_t stop = straight_step(steps.program);
  std::string text = read_whole_file(job.file("plan/program.nc"));
  for (std::size_t line = 1; line < steps.lines[stop]; ++line) text.erase(0, text.find('\n') + 1);
  ASSERT_EQ(text[0], 'N');
  const std::string number = text.substr(0, text.find(' '));
  EXPECT_EQ(resume_block_of(job.resume(number))["step"], stop + 1);
  job.expect_refused("N3", {"`resume` = N3", "no line has this number"});
}

TEST(ResumePlan, RefusesWhatIsNotWithinTheWork) {
  StoppedJob job;
  job.plan();
  const GcodeSteps steps = job.steps();
  job.expect_refused("0", {"`resume` = 0", "outside of the program", "from 1 to "});
  job.expect_refused("999999", {"`resume` = 999999", "outside of the program"});
  job.expect_refused("3",
                     {"`resume` = 3", "before the work, which begins in line " + fmt::format("{}", steps.lines[1])});
  job.expect_refused(job.line_of_step(0), {"before the work"});  // the way down
  job.expect_refused(job.line_of_step(1), {"nothing was removed yet"});
  job.expect_refused(fmt::format("{}", steps.lines.back() + 2), {"behind the last line of the work"});
  job.expect_refused(job.file("no.csv"), {"no.csv"});
  JobOptions none = job.rest_options();
  none.log_plan.clear();
  expect_input_error([&] { resume_plan("40", none, OutputFolder(none.out, plan_files()), {}); },
                     {"`resume` = 40", "`log plan`"});
}

/// A plan on a machine, which a controller's log tells of until it was stopped.
struct LoggedJob : StoppedJob {
  MotionLog log;

  /// What a stop and a new start add at most, as a share of the largest removal: the tool settles once as it comes down
  /// and once more where the rest begins with a straight piece, which ends with a lift (rest_of_path.h), all of it at
  /// its peak rate. To lose and to gain speed takes a twentieth of that here.
  double share_of_start() const {
    const double peak = 10.0;  // nm/s, of the small job's tool
    const HeightMap all = removal_of(read_program(file("plan/program.nc")));
    double largest = 0.0;
    for (const double depth : all.values) largest = std::isfinite(depth) ? std::max(largest, depth) : largest;
    return 1.05 * 2.0 * peak * example_machine().machine.lift.settle / largest;
  }

  LoggedJob() {
    options.machine = folder.file("machine.toml", machine_text(example_machine())).string();
    plan();
    log = test::made_up_log(read_program(file("plan/program.nc")), example_machine().machine);
  }

  /// The log until a share of its samples, written as text.
  std::string log_until(double share) {
    MotionLog part = log;
    const auto samples = static_cast<std::size_t>(share * static_cast<double>(log.size()));
    part.seconds.resize(samples), part.places.resize(samples);
    return folder.file("run.csv", test::log_text(part, "t_s,x_mm,y_mm")).string();
  }
};

TEST(ResumePlan, GoesOnWhereTheLogEnds) {
  LoggedJob job;
  const std::string file = job.log_until(0.6);
  const auto at = static_cast<std::size_t>(0.6 * static_cast<double>(job.log.size())) - 1;
  const WrittenPlan rest = job.resume(file);
  const nlohmann::json block = resume_block_of(rest);
  const Point place = job.log.places[at];
  EXPECT_NEAR(block["place_mm"][0].get<double>(), place.x, 0.01);
  EXPECT_NEAR(block["place_mm"][1].get<double>(), place.y, 0.01);
  // The tool starts again from rest.
  EXPECT_LT(job.deviation(), job.share_of_start());
  EXPECT_LT(rest.exact.statistics.rms, 0.05 * load_job(job.options).part->before.rms);
}

TEST(ResumePlan, RunsUpToALineAsTheMachineDoes) {
  LoggedJob job;
  const WrittenPlan rest = job.resume(job.line_of_step(straight_step(job.steps().program)));
  EXPECT_LT(job.deviation(), job.share_of_start());  // it stops and starts again
  EXPECT_EQ(nlohmann::json::parse(rest.summary)["solve"]["status"], "not run");
}

TEST(ResumePlan, RefusesLogsThatTellNoStop) {
  LoggedJob job;
  job.expect_refused(job.log_until(1.0), {"run.csv", "to the end of its work"});
  for (Point& place : job.log.places) place.x = -place.x;
  job.expect_refused(job.log_until(0.6), {"run.csv", "no log of this path"});
}

/// A log that goes on after the stop: the tool rests, and is taken away.
TEST(ResumePlan, TakesALogThatLeavesThePathAfterARest) {
  LoggedJob job;
  const auto cut = static_cast<std::size_t>(0.6 * static_cast<double>(job.log.size()));
  job.log.seconds.resize(cut), job.log.places.resize(cut);
  const Point place = job.log.places.back();
  const auto go_on = [&job](Point at) {
    job.log.seconds.push_back(job.log.seconds.back() + job.log.period);
    job.log.places.push_back(at);
  };
  for (int i = 0; i < 500; ++i) go_on(place);
  for (int i = 0; i < 500; ++i) go_on(place + Point{-0.02 * i, 0.03 * i});
  const nlohmann::json block = resume_block_of(job.resume(job.log_until(1.0)));
  EXPECT_NEAR(block["place_mm"][0].get<double>(), place.x, 0.01);
  EXPECT_NEAR(block["place_mm"][1].get<double>(), place.y, 0.01);
}

}  // namespace
}  // namespace dwell
