#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/terminal.h"
#include "core/base/units.h"
#include "runs/job/job_file.h"
#include "runs/plan/plan_files.h"
#include "runs/plan/plan_output.h"
#include "solvers/solver_catalogue.h"

namespace dwell::cli {
namespace {

struct PlanArguments {
  std::unique_ptr<JobArguments> job;
  bool json = false;
  bool write_job = false;
};

void print_plan(const Plan& plan, const WrittenPlan& written) {
  const Grid& g = plan.map.grid;
  fmt::print("map       {} rows x {} columns of {:.6g} mm, {} pixels in the aperture\n", g.rows, g.cols, g.pitch_x,
             plan.before.valid_pixels);
  fmt::print("before    RMS {:.4g} nm, PV {:.4g} nm ({} removed)\n", plan.before.rms, plan.before.pv,
             to_string(plan.terms));
  fmt::print("tool      {}, peak {:.4g} nm/s, volume {:.4g} nm mm^2/s, FWHM {:.4g} mm, radius {:.4g} mm\n",
             kind_of(plan.tif), plan.tif.peak, plan.tif.volume, plan.tif.fwhm, plan.tif.radius);
  fmt::print("path      {}, {} points, {:.6g} mm, longest jump {:.4g} mm, {} lifts\n", plan.path.kind,
             plan.metrics.points, plan.metrics.length, plan.metrics.longest_jump, plan.metrics.lifts);
  for (const std::string& note : plan.path.notes) fmt::print("          {}\n", note);
  fmt::print("weights   smoothness {:.4g}, time price {:.4g} nm^2/s ({})\n", plan.weights.smoothness,
             plan.weights.time_price,
             plan.search ? fmt::format("chosen from {} solves", plan.search->trials.size()) : "given");
  fmt::print("solver    {}: {} after {} iterations, {} operator applications, {:.2f} s\n", to_string(plan.solver.kind),
             to_string(plan.solver.status), plan.solver.iterations, plan.solver.operator_applications,
             plan.solver.seconds);
  fmt::print("dwell     total {:.2f} s, from {:.4g} s to {:.4g} s a point, step RMS {:.4g} s\n", plan.dwell.sum(),
             plan.dwell.minCoeff(), plan.dwell.maxCoeff(), plan.step_rms);
  fmt::print("feed      {:.4g} to {:.4g} mm/min, {} of {} segments at a limit\n",
             units::mm_per_min(plan.feed.min_speed), units::mm_per_min(plan.feed.max_speed), plan.feed.segments_limited,
             plan.path.size());
  fmt::print("predicted RMS {:.4g} nm, PV {:.4g} nm by the solver\n", plan.residual.rms, plan.residual.pv);
  fmt::print("program   RMS {:.4g} nm, PV {:.4g} nm by simulating program.nc as read back, {:.2f} s\n",
             written.simulated.rms, written.simulated.pv, written.program_seconds);
}

int run_plan(const PlanArguments& arguments) {
  const JobOptions options = arguments.job->options();
  if (arguments.write_job) {
    fmt::print("{}", job_file_text(options));
    return kDone;
  }
  OutputFolder folder(options.out, plan_files());
  const Progress progress = terminal_progress();
  Plan plan = make_plan(options, progress);
  const WrittenPlan written = write_plan(plan, folder, progress);
  folder.commit();
  finish_progress();
  if (arguments.json) {
    fmt::print("{}", written.summary);
  } else {
    print_plan(plan, written);
    fmt::print("written   {}\n", options.out);
  }
  for (const std::string& limit : plan.limits) fmt::print(stderr, "dwell: limit reached: {}\n", limit);
  return plan.limits.empty() ? kDone : kLimitReached;
}

}  // namespace

void add_plan_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("plan", "plan a run: path, dwell, feed table, program, predicted surface");
  auto arguments = std::make_shared<PlanArguments>();
  arguments->job = std::make_unique<JobArguments>(*command, every_flag(), true);
  command->add_flag("--json", arguments->json, "print summary.json on standard output instead of the table");
  command->add_flag("--write-job", arguments->write_job,
                    "print a job file with these options, with comments, and stop");
  command->footer(
      "Example:\n"
      "  dwell plan --map mirror.csv --map-pixel 0.0938 --tif spot.csv --tif-pixel 0.0938 \\\n"
      "             --path raster:pitch=1 --max-feed 3000 --out plan/\n"
      "Exit codes: 0 done, 1 internal fault, 2 bad usage or input, 3 done but a limit was reached, 130 interrupted.");
  command->callback([arguments, &exit_code] { exit_code = run_plan(*arguments); });
}

}  // namespace dwell::cli
