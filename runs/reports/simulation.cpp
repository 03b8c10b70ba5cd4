#include "runs/reports/simulation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

#include "core/base/counted.h"
#include "core/base/whole_file.h"
#include "core/form/map_statistics.h"
#include "core/form/robust_pv.h"
#include "core/formats/map_name.h"
#include "core/map/part_distance.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "paths/feed/late_motion.h"
#include "paths/feed/machine_check.h"
#include "runs/base/inputs_json.h"
#include "runs/job/job.h"
#include "runs/job/line_profile_map.h"
#include "runs/job/program_style.h"
#include "runs/machine/machine_option.h"
#include "runs/plan/counted_pixels.h"
#include "runs/plan/program_prediction.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/acceptance_report.h"
#include "runs/reports/anatomy_lines.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/machine_report.h"
#include "runs/reports/residual_advice.h"
#include "runs/reports/tool_sheet.h"

namespace dwell {
namespace {

/// Refuses a tool at work far from the part. Lifted moves may come from anywhere.
void check_steps(const Program& program, const Part& part) {
  std::size_t number = 0;
  for (const ProgramStep& step : program.steps) {
    ++number;
    if (!step.removes) continue;
    for (const Point p : {step.start, step.finish}) {
      check_near_part(p, part.map.grid, part.tif.radius, [&] {
        return fmt::format("{}: the place of the tool at work in step {}", program.file, number);
      });
    }
  }
}

/// A program as a machine runs it, in the place of the program as commanded.
Program executed_on(const NamedMachine& machine, const Program& program, const std::optional<LearntFiles>& learnt,
                    ExecutedProgram& executed, std::vector<std::string>& limits, const Progress& progress) {
  progress.report("simulate: motion of the machine");
  Execution run = execute(program, machine.machine, progress);
  if (learnt) {
    if (learnt->late.size() != program.steps.size())
      throw InputError(fmt::format("{}: {} but {} has {}; required one for each", kLateFile,
                                   counted(learnt->late.size(), "row"), program.file,
                                   counted(program.steps.size(), "step")));
    run.motion = late_motion(run, learnt->late);
    for (std::size_t i = 0; i < run.seconds.size(); ++i) run.seconds[i] += learnt->late[i];
    executed.logs = learnt->logs;
  }
  limits = beyond_machine(program, machine.machine);
  executed.machine = machine;
  executed.run_seconds = run.motion.run_seconds();
  executed.max_acceleration = run.max_acceleration;
  executed.lifts = lift_totals(program, machine.machine);
  constexpr double kSlow = 1.01;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    if (!step.removes || !(step.length() > 0.0)) continue;
    ++executed.removing_steps;
    executed.slow_steps += static_cast<std::size_t>(run.seconds[i] > kSlow * step.seconds);
  }
  return std::move(run.motion);
}

/// What the commanded speeds would leave, beside what the motion leaves.
void compare_with_commanded(const Part& part, const Program& program, const LatticeChoice& lattice, Simulation& s,
                            const Progress& progress) {
  ExecutedProgram& executed = *s.executed;
  const ExactResidual commanded = predict_program(part, program, lattice.kernel, progress);
  executed.commanded = {commanded.statistics, program.run_seconds(s.max_feed)};
  HeightMap change = commanded.surface;
  for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] -= s.after.surface.values[i];
  executed.removal_change = map_statistics(change, part.form, part.threads).rms_about_zero();
}

}  // namespace

Simulation simulate_file(const std::filesystem::path& program, const GcodeReading& reading, const JobOptions& options,
                         const Progress& progress, bool every_pixel, const SimulationSource& source, bool keep_nodes) {
  Simulation s;
  progress.report("read: program, map and removal function");
  GcodeReading read_as = reading;
  if (!options.machine.empty()) read_as.letters = machine_of_option(options.machine).machine.letters;
  s.program = read_program(program, read_as, progress);
  s.inputs.push_back({"program", program.string(), sha256_of_file(program)});
  const Job job = load_job(without_program_style(options), progress);
  const Part& part = *job.part;
  s.plan = source.plan;
  if (!s.plan.empty()) s.max_feed = dwell_options(job).machine.feed_limits().max_feed;
  s.differences = source.given;
  for (std::string& difference :
       differences_from_record(read_program_record(program, reading.layout ? &*reading.layout : nullptr),
                               program.string(), job, source.other, s.plan.empty())) {
    s.differences.push_back(std::move(difference));
  }
  s.inputs.insert(s.inputs.end(), job.inputs.begin(), job.inputs.end());
  s.terms = part.form;
  s.before = part.before;
  s.map = {surface_file(options),       part.map.grid,      part.map.history, job.map_pixels,
           to_string(options.aperture), to_string(s.terms), s.before};
  s.tif = part.tif;
  s.volume_factor = part.kernel.volume_factor;
  check_steps(s.program, part);
  std::optional<Program> motion;
  if (job.machine)
    motion = executed_on(*job.machine, s.program, source.learnt, s.executed.emplace(), s.limits, progress);
  if (job.machine && keep_nodes) s.nodes = motion_nodes(s.program, job.machine->machine, progress);
  const Program& run = motion ? *motion : s.program;
  const Progress simulating = progress.of_part(fmt::format("simulate {}", counted(s.program.steps.size(), "step")));
  LatticeChoice lattice = choose_lattice(part, removing_steps(run).strokes, simulating);
  std::optional<Part> changed;
  if (source.learnt) changed = with_learnt_removal(part, source.learnt->removal);
  const Part& predicted = changed ? *changed : part;
  s.after = predict_program(predicted, run, lattice.kernel, simulating,
                            every_pixel ? ExactCheck::EveryPixel : ExactCheck::Figure);
  while (!s.after.all && lattice_too_coarse(s.after, part.before) && !lattice.finest) {
    lattice = finer_lattice(part, lattice);
    s.after = predict_program(predicted, run, lattice.kernel, simulating);
  }
  s.counted = counted_figures(job, s.after.surface);
  if (!part.beside.values.empty()) s.beside = shown_surface(part, s.after.surface, run, lattice.kernel);
  if (s.executed) compare_with_commanded(part, s.program, lattice, s, simulating);
  if (source.log) {
    s.recorded = recorded_run(*source.log, s.program, job.machine ? std::optional(job.machine->machine) : std::nullopt,
                              part, lattice.kernel, s.after.surface, progress.of_part("log"));
    s.inputs.push_back({"log", source.log->file, sha256_of_file(split_map_name(source.log->file).file)});
  }
  s.after.statistics = with_robust_pv(s.after.statistics, s.after.surface, part.threads);
  s.anatomy = residual_anatomy(s.after.surface, part.tif.fwhm, part.form, part.threads, BlemishSearch::On,
                               progress.of_part("what is left"));
  AdviceFacts facts;
  facts.blemishes_left_out = !s.plan.empty() && options.blemishes == BlemishHandling::LeaveOut;
  s.advice = residual_advice(s.anatomy, facts);
  if (auto limit = more_than_before(s.after, s.before)) s.limits.push_back(std::move(*limit));
  s.acceptance = judge_residual(s.after, job.accept, part.threads, progress.of_part("what is left"));
  for (std::string& unmet : unmet_limits(s.acceptance)) s.limits.push_back(std::move(unmet));
  return s;
}

std::string simulation_json(const Simulation& s) {
  nlohmann::ordered_json json = json_of_command("simulate");
  json["map"] = map_block(s.map);
  json["tif"] = tif_block(s.tif, kind_of(s.tif), s.tif.samples.history, s.volume_factor);
  json["tool"] = tool_block(tool_sheet(s.tif));
  ProgramFigures program = program_figures(s.program, s.after, to_string(s.terms), s.max_feed);
  if (s.executed) program.seconds = s.executed->run_seconds;
  json["program"] = program_block(program);
  if (s.executed) {
    const ExecutedProgram& e = *s.executed;
    json["machine"] = machine_block(e.machine);
    json["executed"] = {{"total_s", e.run_seconds},
                        {"logs", e.logs},
                        {"slow_steps", e.slow_steps},
                        {"removing_steps", e.removing_steps},
                        {"max_acceleration_mm_per_s2", e.max_acceleration},
                        {"removal_change_rms_nm", e.removal_change},
                        {"commanded_rms_nm", e.commanded.residual.rms},
                        {"commanded_total_s", e.commanded.run_seconds}};
    if (e.lifts.any()) json["executed"]["lift_rests"] = lift_block(e.lifts);
  }
  if (s.recorded) json["recorded"] = recorded_block(*s.recorded);
  json["anatomy"] = anatomy_block(s.anatomy, s.advice);
  if (!s.acceptance.empty()) json["acceptance"] = acceptance_block(s.acceptance);
  if (s.counted) json["counted"] = counted_block(*s.counted);
  if (!s.plan.empty()) json["plan"] = s.plan;
  json["differences"] = s.differences;
  json["limits"] = s.limits;
  json["inputs"] = inputs_json(s.inputs);
  return json_text(std::move(json));
}

}  // namespace dwell
