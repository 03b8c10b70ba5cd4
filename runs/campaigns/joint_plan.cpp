#include "runs/campaigns/joint_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

#include "core/base/errors.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "paths/feed/plan_program.h"
#include "runs/job/option_flags.h"
#include "runs/job/program_style.h"
#include "runs/job/tool_option.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/objective_rows.h"
#include "runs/plan/usual_smoothness.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/another_surface.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "solvers/weights/weight_option.h"

namespace dwell {
namespace {

/// A tool with its files read and its path laid.
struct LoadedTool {
  ToolSpec option;
  Job job;
  LaidPath laid;
};

void refuse(const std::string& option, const std::string& why) {
  throw InputError(fmt::format("{} together with `tool`: {}", option, why));
}

/// What holds for all tools is refused as the job's, before any file is read.
void check_joint_options(const JobOptions& o) {
  for (const auto& [name, goal] : {std::pair("smoothness", o.smoothness), {"time price", o.time_price_nm2_per_s}}) {
    const bool of_time = std::string_view(name) == "time price";
    if (goal.kind == GoalKind::Fixed || goal.kind == GoalKind::Auto) continue;
    if (of_time && goal.kind == GoalKind::TotalAtMost) continue;
    refuse(fmt::format("`{}` = {}", name, to_string(goal)),
           fmt::format("it is searched over plans, which is for one tool; required a number or auto{}",
                       of_time ? ", or total<=SECONDS" : ""));
  }
  if (o.fraction != 1.0) refuse(fmt::format("`fraction` = {}", o.fraction), "required 1");
  if (o.solver == SolverKind::Fourier) refuse("`solver` = fourier", "it knows one tool; required another");
  if (o.blemishes == BlemishHandling::LeaveOut)
    refuse("`blemishes` = leave-out", "pixels are left out by one plan; accepted: report or keep");
  if (!o.log.empty() || !o.log_plan.empty())
    refuse(o.log.empty() ? fmt::format("`log plan` = {}", o.log_plan) : fmt::format("`log` = {}", o.log),
           "a log is of one program; required a plan for one tool");
  if (o.uncertainty || o.robust_plan)
    refuse(o.robust_plan ? "`robust plan`" : "`uncertainty`",
           "truths are drawn for the program of one tool; required none");
  if (o.certify > 0.0)
    refuse(fmt::format("`certify` = {:g}%", 100.0 * o.certify), "the bound is that of one tool's plan; required off");
}

LoadedTool load_tool(const ToolSpec& option, const JobOptions& common, const Progress& progress) {
  LoadedTool tool{option, {}, {}};
  const JobOptions own = options_of_tool(common, option);
  try {
    if (own.tif.empty()) throw InputError("tif: required, its own or the job's --tif");
    if (!own.path.given()) throw InputError("path: required, its own or the job's --path");
    if (own.schedule != ScheduleKind::Constant)
      throw InputError(
          fmt::format("`schedule` = {}: what its speeds remove is not taken over by the next tool; required constant",
                      to_string(own.schedule)));
    check_exports(own);
    tool.job = load_job(own, progress);
    tool.laid = lay_job_path(tool.job, 0.0, progress).laid;
    if (auto file = path_input(own)) tool.job.inputs.push_back(std::move(*file));
  } catch (const InputError& error) {
    const std::string what = with_flags(error).what();
    if (what.find(surface_file(own)) != std::string::npos) throw;  // of the map, which is the job's
    throw InputError(fmt::format("tool '{}': {}", option.name, what));
  }
  return tool;
}

/// Refuses tools that are the same, which would only share the smoothness that one has to keep; and prices where time
/// is not priced.
void check_specs(const std::vector<ToolSpec>& specs, const JobOptions& options) {
  for (std::size_t a = 0; a < specs.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (specs[a].values == specs[b].values)
        throw InputError(
            fmt::format("tools '{}' and '{}' are the same; required tools that differ", specs[b].name, specs[a].name));
    }
    if (options.time_price_nm2_per_s.kind == GoalKind::TotalAtMost && specs[a].price != 1.0) {
      throw InputError(fmt::format(
          "tool '{}': price: {}; required 1 together with `time price` = {}, within which all seconds count "
          "alike",
          specs[a].name, specs[a].price, to_string(options.time_price_nm2_per_s)));
    }
  }
}

/// All tools, wide ones first.
std::vector<LoadedTool> load_tools(const JobOptions& options, const Progress& progress) {
  std::vector<LoadedTool> tools;
  const std::vector<ToolSpec> specs = parse_tool_specs(options.tools);
  check_specs(specs, options);
  tools.reserve(specs.size());
  for (const ToolSpec& option : specs) tools.push_back(load_tool(option, options, progress.of_part(option.name)));
  std::stable_sort(tools.begin(), tools.end(), [](const LoadedTool& a, const LoadedTool& b) {
    return equivalent_fwhm(*a.job.part) > equivalent_fwhm(*b.job.part);
  });
  return tools;
}

/// Slopes count alike for all tools: by the length of the widest.
void share_slope_length(std::vector<LoadedTool>& tools) {
  for (LoadedTool& tool : tools) {
    FitObjective& objective = tool.job.options.objective;
    if (objective.has_slopes()) objective.length = slope_length(*tools.front().job.part, objective);
  }
}

std::vector<JointTool> joint_tools(const std::vector<LoadedTool>& loaded) {
  std::vector<JointTool> tools;
  tools.reserve(loaded.size());
  for (const LoadedTool& tool : loaded) {
    tools.push_back({tool.option.name, tool.job.part, tool.laid, dwell_options(tool.job), tool.option.price,
                     tool.option.change_over_s});
  }
  return tools;
}

/// What a program removes of a surface, on the lattice that holds the tool [nm].
HeightMap removal_by(const Program& program, const Part& part, const HeightMap& surface, const Progress& progress) {
  const LatticeChoice lattice = choose_lattice(part, removing_steps(program).strokes, progress.of_part("lattice"));
  progress.check();
  return simulate(program, surface, lattice.kernel, part.threads);
}

/// What a tool is to remove by the joint solve.
HeightMap planned_removal(const LoadedTool& tool, const Vector& seconds, const HeightMap& surface,
                          const Progress& progress) {
  const double feed = dwell_options(tool.job).machine.feed_limits().max_feed;
  const Program run = program_of(tool.laid.path, {seconds.begin(), seconds.end()}, tool.laid.motion, feed);
  return removal_by(run, *tool.job.part, surface, progress);
}

/// What the program in a plan's folder removes, as the tool's machine runs it.
HeightMap programmed_removal(const LoadedTool& tool, const std::filesystem::path& program, const HeightMap& surface,
                             const Progress& progress) {
  GcodeReading reading;
  if (tool.job.machine) reading.letters = tool.job.machine->machine.letters;
  Program run = read_program(program, reading, progress);
  if (tool.job.machine) {
    const Machine machine = machine_for_program(tool.job.machine->machine, tool.job.options);
    run = execute(run, machine, progress).motion;
  }
  return removal_by(run, *tool.job.part, surface, progress);
}

/// A tool's share of the dwell problem as a plan of its own.
Job job_of_run(const LoadedTool& tool, const std::string& folder, double smoothness, const WeightGoal& price) {
  Job job = tool.job;
  job.options.out = (std::filesystem::path(job.options.out) / folder).string();
  job.options.smoothness = {smoothness};
  job.options.time_price_nm2_per_s = price;
  job.options.time_worth = {};
  return job;
}

class Runs {
 public:
  Runs(JointPlan& plan, const std::vector<LoadedTool>& tools, const OutputFolder& folder, const Progress& progress)
      : plan_(plan), tools_(tools), folder_(folder), progress_(progress) {}

  void plan_all() {
    surface_ = whole_surface(*tools_.front().job.part);
    plan_planned_removals();
    const std::vector<std::size_t>& chosen = plan_.choice.dwell.tools;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const std::string stage = fmt::format("tool {} of {}, {}", i + 1, chosen.size(), plan_.names[chosen[i]]);
      progress_.report(stage);
      plan_one(i, progress_.of_part(stage));
    }
  }

 private:
  void plan_planned_removals() {
    const JointDwell& dwell = plan_.choice.dwell;
    for (std::size_t i = 0; i < dwell.tools.size(); ++i)
      planned_.push_back(planned_removal(tools_[dwell.tools[i]], dwell.seconds[i], surface_, progress_));
  }

  /// The surface now, less what the tools after the i-th are to remove.
  HeightMap surface_for(std::size_t i) const {
    HeightMap surface = surface_;
    for (std::size_t later = i + 1; later < planned_.size(); ++later) surface = surface_after(surface, planned_[later]);
    return surface;
  }

  MapStatistics statistics(const Part& part) const {
    HeightMap counted = surface_;
    for (std::size_t k = 0; k < counted.values.size(); ++k) {
      if (!std::isfinite(part.map.values[k])) counted.values[k] = part.map.values[k];
    }
    return map_statistics(counted, part.form, part.threads);
  }

  /// The tool's price of a second; with a machine that has to keep to a total, its share of that.
  WeightGoal price_of_run(std::size_t i) const {
    const JointDwell& dwell = plan_.choice.dwell;
    const LoadedTool& tool = tools_[dwell.tools[i]];
    const bool total = plan_.job.options.time_price_nm2_per_s.kind == GoalKind::TotalAtMost;
    if (total && tool.job.machine) return {dwell.seconds[i].sum(), GoalKind::TotalAtMost};
    return {plan_.choice.set().price * tool.option.price};
  }

  void plan_one(std::size_t i, const Progress& progress) {
    const std::size_t number = plan_.choice.dwell.tools[i];
    const LoadedTool& tool = tools_[number];
    ToolRun run;
    run.tool = number;
    run.folder = fmt::format("{}-{}", i + 1, tool.option.name);
    run.price = tool.option.price;
    run.change_over = tool.option.change_over_s;
    run.before = statistics(*tool.job.part);
    OutputFolder own(folder_.path(run.folder), plan_files());
    Job job = job_of_run(tool, run.folder, plan_.smoothnesses[number], price_of_run(i));
    HeightMap surface = surface_for(i);
    surface.history = surface_.history;
    if (i + 1 < planned_.size())
      surface.history.emplace_back(
          "what the tools after this one are to remove taken off: it is not a measured surface");
    replace_surface(job, surface, own, kToolSurface, progress);
    if (i + 1 < planned_.size()) job.accept.clear();  // which is of the surface after all
    const PlannedJob planned = plan_job(std::move(job), {tool.laid, std::nullopt}, progress);
    const WrittenPlan written = write_plan(planned, own, progress);
    const HeightMap removed = programmed_removal(tool, own.path(written.program.file), surface_, progress);
    own.commit();
    surface_ = surface_after(surface_, removed);
    surface_.history.push_back(fmt::format("what the program of tool {} removes taken off", tool.option.name));
    run.left = i + 1 < planned_.size() ? statistics(*tool.job.part) : written.exact.statistics;
    run.dwell = planned.dwell.run_dwell();
    run.seconds = written.run_seconds;
    run.limits = written.limits;
    run.warnings = written.warnings;
    plan_.acceptance = written.acceptance;
    plan_.runs.push_back(std::move(run));
  }

  JointPlan& plan_;
  const std::vector<LoadedTool>& tools_;
  const OutputFolder& folder_;
  const Progress& progress_;
  HeightMap surface_;               // now, all pixels with data [nm]
  std::vector<HeightMap> planned_;  // what each tool that pays is to remove [nm]
};

/// Says so where the machine takes longer than the total that was asked for.
void check_total(JointPlan& plan, const WeightGoal& goal) {
  if (goal.kind != GoalKind::TotalAtMost) return;
  double taken = plan.change_over();
  for (const ToolRun& run : plan.runs) taken += run.dwell;
  constexpr double kHeld = 1e-3;
  if (taken <= (1.0 + kHeld) * goal.value) return;
  plan.limits.push_back(
      fmt::format("--time-price is total<={:g} s, but dwell and change-over take {:.6g} s", goal.value, taken));
}

}  // namespace

double JointPlan::change_over() const {
  return std::accumulate(runs.begin(), runs.end(), 0.0,
                         [](double sum, const ToolRun& r) { return sum + r.change_over; });
}

double JointPlan::seconds() const {
  return std::accumulate(runs.begin(), runs.end(), 0.0, [](double sum, const ToolRun& r) { return sum + r.seconds; });
}

const ResultFiles& joint_plan_files() {
  static const ResultFiles kFiles{"plan for several tools", "tools.json", {}, {}, &plan_files(), true};
  return kFiles;
}

JointPlan plan_tools(const JobOptions& options, const OutputFolder& folder, const Progress& progress) {
  check_joint_options(options);
  check_weights(dwell_options(options));
  std::vector<LoadedTool> tools = load_tools(options, progress);
  share_slope_length(tools);
  JointPlan plan;
  plan.job = tools.front().job;
  plan.job.options = options;
  for (const LoadedTool& tool : tools) {
    plan.names.push_back(tool.option.name);
    plan.tif.push_back(tool.job.options.tif);
    plan.fwhm.push_back(tool.job.part->tif.fwhm);
    plan.prices.push_back(tool.option.price);
    plan.change_overs.push_back(tool.option.change_over_s);
  }
  {
    progress.report("several tools: setting up");
    JointProblem problem(joint_tools(tools), progress);
    for (std::size_t k = 0; k < tools.size(); ++k) plan.smoothnesses.push_back(problem.smoothness(k));
    plan.choice =
        choose_tools(problem, options.time_price_nm2_per_s, options.time_worth, options.max_solve_s, progress);
  }
  for (const TriedTools& tried : plan.choice.tried) {
    if (tried.status == SolverStatus::Converged || tried.status == SolverStatus::Settled) continue;
    std::string set;
    for (const std::size_t k : tried.tools) set += (set.empty() ? "" : " + ") + plan.names[k];
    plan.limits.push_back(fmt::format("joint solve of {}: {}; its cost may be too high, and the choice of tools wrong",
                                      set, to_string(tried.status)));
  }
  Runs(plan, tools, folder, progress).plan_all();
  for (const ToolRun& run : plan.runs) {
    for (const std::string& limit : run.limits) plan.limits.push_back(fmt::format("{}: {}", run.folder, limit));
  }
  check_total(plan, options.time_price_nm2_per_s);
  for (const LoadedTool& tool : tools) {
    for (const InputFile& input : tool.job.inputs) {
      const bool known = std::any_of(plan.job.inputs.begin(), plan.job.inputs.end(), [&input](const InputFile& other) {
        return other.role == input.role && other.file == input.file;
      });
      if (!known) plan.job.inputs.push_back(input);
    }
  }
  return plan;
}

}  // namespace dwell
