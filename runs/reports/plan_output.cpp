#include "runs/reports/plan_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/side_by_side.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "core/base/word_list.h"
#include "core/form/robust_pv.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "paths/feed/execution.h"
#include "paths/feed/late_motion.h"
#include "paths/feed/machine_check.h"
#include "runs/job/learnt_files.h"
#include "runs/job/option_flags.h"
#include "runs/job/program_style.h"
#include "runs/plan/counted_pixels.h"
#include "runs/plan/program_prediction.h"
#include "runs/programs/gcode_parts.h"
#include "runs/programs/program_comments.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/acceptance_report.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/plan_costs.h"
#include "runs/reports/plan_pictures.h"
#include "runs/reports/plan_summary.h"
#include "runs/reports/plan_warnings.h"
#include "runs/reports/program_record.h"
#include "runs/reports/residual_advice.h"
#include "runs/reports/template_program.h"
#include "runs/reports/weight_lines.h"

namespace dwell {
namespace {

const std::string kTemplateWord = "template";  // of the program by a template among the exports

/// Whether the plan has a schedule of speeds, which feeds cannot say: then it has no feed table and no G-code.
bool says_speeds_alone(const PlannedJob& plan) { return plan.dwell.motion && plan.dwell.motion->program; }

std::vector<WrittenProgram> write_program(const PlannedJob& plan, const OutputFolder& folder,
                                          const Progress& progress) {
  const JobOptions& options = plan.job.options;
  ProgramToWrite to_write{plan.program.table, plan.program.motion, says_speeds_alone(plan)};
  FeedTable& table = to_write.table;
  table.version = version();
  table.frame = program_frame(options);
  for (const InputFile& input : plan.job.inputs) table.inputs.emplace_back(input.role + " " + input.file, input.sha256);
  table.options = options_of_record(options);
  const ProgramWriting writing{options.gcode, options.lift_height_mm, program_comments(table),
                               gcode_style(options, plan.job.machine, plan.job.header, plan.job.footer),
                               plan.job.machine ? std::optional(plan.job.machine->machine) : std::nullopt};
  std::vector<WrittenProgram> programs =
      written_programs(to_write, writing, options.exports, plan.part().threads, progress);
  if (const auto& layout = plan.job.layout) {
    progress.step("write: " + layout->output());
    programs.push_back({layout->output(), template_program_text(plan, table, writing.header, progress), kTemplateWord});
  }
  for (const WrittenProgram& program : programs) folder.write(program.file, program.bytes);
  return programs;
}

/// Reads a program of the plan back from disk. It is called by its own name in all messages, and not by the temporary
/// folder in which it lies until the plan is whole.
Program read_back(const PlannedJob& plan, const OutputFolder& folder, const std::string& name,
                  const Progress& progress) {
  GcodeReading reading;
  if (plan.job.machine) reading.letters = plan.job.machine->machine.letters;
  if (plan.job.layout && name == plan.job.layout->output()) reading.layout = plan.job.layout;
  try {
    Program program = read_program(folder.path(name), reading, progress);
    program.file = name;
    return program;
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::string place = folder.path(name).string();
    if (const std::size_t at = what.find(place); at != std::string::npos) what.replace(at, place.size(), name);
    throw InputError(what);
  }
}

/// A program as the job's machine runs it, with what a log has taught; as it is without a machine.
Program run_of(const PlannedJob& plan, const Program& program, const Progress& progress) {
  if (!plan.job.machine) return program;
  const bool of_speeds =
      std::any_of(program.steps.begin(), program.steps.end(), [](const auto& step) { return step.speeds.has_value(); });
  // A table of positions, velocities and times says its own times: what logs of feeds have taught is not of it.
  const LearntMotion* learnt = plan.job.lesson && !of_speeds ? &plan.job.lesson->run.learnt : nullptr;
  return learnt_execution(program, machine_for_program(plan.job.machine->machine, plan.job.options), learnt,
                          stroke_moves(plan.laid.path, plan.laid.motion), progress);
}

/// The part on which a simulated motion leaves what the machine leaves.
const Part& part_to_predict_on(const PlannedJob& plan, std::optional<Part>& changed) {
  if (!plan.job.lesson) return plan.part();
  return changed.emplace(with_learnt_removal(plan.part(), plan.job.lesson->run.learnt.removal));
}

/// What the job's log has taught goes into the folder, for the next log and for simulations.
void write_learnt(const PlannedJob& plan, const OutputFolder& folder, const Program& program, WrittenPlan& written) {
  if (!plan.job.lesson) return;
  const LearntMotion& learnt = plan.job.lesson->run.learnt;
  const std::vector<Index> stroke = strokes_of_steps(program, stroke_moves(plan.laid.path, plan.laid.motion));
  const Execution execution = execute(program, machine_for_program(plan.job.machine->machine, plan.job.options));
  folder.write(kLateFile, late_text(stroke, late_of_steps(stroke, execution.seconds, learnt.late)));
  write_map(folder.path(kLearntRemovalFile), learnt.removal);
  written.late_sha256 = sha256_of_file(folder.path(kLateFile));
  written.learnt_removal_sha256 = sha256_of_file(folder.path(kLearntRemovalFile));
}

bool differs(double a, double b, double tolerance) {
  return !(std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)));
}

/// Says so where a program on disk leaves over 0.1 % otherwise than with its numbers as they were before they were
/// rounded to the steps of the controller.
void say_rounding(const std::string& file, double left, double unrounded, WrittenPlan& written) {
  constexpr double kMatters = 1e-3;
  if (!differs(left, unrounded, kMatters)) return;
  written.warnings.push_back(
      fmt::format("{} leaves {:.6g} nm RMS, {:+.2g} % against the {:.6g} nm of its numbers before they were rounded to "
                  "the steps of the machine's controller",
                  file, left, 100.0 * (left / unrounded - 1.0), unrounded));
}

bool has_coarse_controller(const PlannedJob& plan) {
  return plan.job.machine && plan.job.machine->machine.controller.is_coarse();
}

/// feed.csv and program.nc are two forms of one program and must remove the same. Where their steps differ by more than
/// rounding, what the table removes is predicted as well, and a difference is a limit.
void compare_with_table(const PlannedJob& plan, const Program& program, const Program& table, WrittenPlan& written,
                        const Progress& progress) {
  written.table_has_same_steps =
      same_removing_steps(program, table, units::mm_per_s(plan.job.options.max_feed_mm_per_min));
  if (*written.table_has_same_steps) return;
  std::optional<Part> changed;
  const ExactResidual from_table = predict_program(part_to_predict_on(plan, changed), run_of(plan, table, progress),
                                                   plan.dwell.lattice.kernel, progress);
  const double left = written.exact.statistics.rms_about_zero(), by_table = from_table.statistics.rms_about_zero();
  if (has_coarse_controller(plan)) return say_rounding("program.nc", left, by_table, written);  // the table is not
  if (differs(left, by_table, std::max(1e-3, 3.0 * written.exact.standard_error / left))) {
    written.limits.push_back(fmt::format("program.nc leaves {:.6g} nm RMS{} but feed.csv {:.6g} nm", left,
                                         about_zero_in_words(written.exact.statistics), by_table));
  }
}

/// About zero, since a piston counts where it is not removed.
void compare_with_solver(const PlannedJob& plan, WrittenPlan& written) {
  const double left = written.exact.lattice_rms;
  const double expected = plan.dwell.motion ? plan.dwell.motion->executed() : plan.dwell.residual.rms_about_zero();
  if (differs(left, expected, kSimulationTolerance)) {
    written.limits.push_back(fmt::format("the simulated program leaves {:.4g} nm RMS{}, the {} expected {:.4g} nm",
                                         left, about_zero_in_words(plan.dwell.residual),
                                         plan.dwell.motion ? "schedule" : "solver", expected));
  }
  if (auto limit = more_than_before(written.exact, plan.part().before)) written.limits.push_back(std::move(*limit));
}

/// What the surface that is left is like. Its anatomy takes about as long as slopes and bands with what is to be done
/// beside them.
void study_surface(const PlannedJob& plan, WrittenPlan& written, const Progress& progress,
                   const std::function<void(const Progress& progress)>& beside) {
  const Part& part = plan.part();
  const bool search = plan.job.options.blemishes != BlemishHandling::Keep;
  MapStatistics statistics;
  run_side_by_side(
      part.threads, progress,
      [&](const Progress& shared, int threads) {
        statistics = with_robust_pv(written.exact.statistics, written.exact.surface, threads);
        written.anatomy =
            residual_anatomy(written.exact.surface, part.tif.fwhm, part.form, threads,
                             search ? BlemishSearch::On : BlemishSearch::Off, shared.of_part("what is left"));
      },
      [&](const Progress& shared, int threads) {
        beside(shared);
        written.surface =
            surface_sheet(part.figure, written.exact.surface, part.tif.fwhm, threads, shared.of_part("simulate"));
      });
  written.exact.statistics = statistics;
  written.advice = residual_advice(written.anatomy, advice_facts(plan));
  written.acceptance = judge_residual(written.exact, plan.job.accept, part.threads, progress);
  for (std::string& unmet : unmet_limits(written.acceptance)) written.limits.push_back(std::move(unmet));
}

/// The first program of positions, velocities and times, whose figure holds for others of the same steps.
struct FirstExport {
  Program program;
  MapStatistics residual;
};

/// Whether an exported program is one of feeds, which the machine makes a motion of.
bool says_feeds(const PlannedJob& plan, const WrittenProgram& one) {
  return one.word == kGcodePartsWord || (one.word == kTemplateWord && !plan.job.layout->speeds);
}

/// An exported program, read back from disk: it must keep the machine's limits as it stands in its file, and leave what
/// the plan's program leaves. `first`: the one before, whose figure holds for the same steps.
WrittenExport check_written_export(const PlannedJob& plan, const OutputFolder& folder, const WrittenProgram& one,
                                   const std::vector<WrittenProgram>& programs, std::optional<FirstExport>& first,
                                   WrittenPlan& written, const Progress& progress) {
  progress.report("simulate: " + one.file + " as read back from disk");
  Program program = read_back(plan, folder, one.file, progress);
  WrittenExport now;
  now.word = one.word;
  now.file = one.file;
  now.sha256 = sha256_of_file(folder.path(one.file));
  now.files = static_cast<std::size_t>(
      std::count_if(programs.begin(), programs.end(), [&](const auto& file) { return file.word == one.word; }));
  now.steps = program.steps.size();
  if (plan.job.machine) {
    for (const std::string& fault : beyond_machine(program, plan.job.machine->machine))
      written.limits.push_back(fmt::format("{}: {}", one.file, fault));
  }
  const bool feeds = says_feeds(plan, one);
  const Program run = run_of(plan, program, progress);
  now.total_s = (feeds ? run : program).run_seconds(dwell_options(plan.job).machine.feed_limits().max_feed);
  const bool same = !feeds && first &&
                    same_removing_steps(program, first->program, units::mm_per_s(plan.job.options.max_feed_mm_per_min));
  std::optional<Part> changed;
  const Part& part = feeds ? part_to_predict_on(plan, changed) : plan.part();
  now.residual = same ? first->residual : predict_program(part, run, plan.dwell.lattice.kernel, progress).statistics;
  const double left = written.exact.statistics.rms_about_zero(), by_file = now.residual.rms_about_zero();
  if (differs(left, by_file, std::max(kSimulationTolerance, 3.0 * written.exact.standard_error / left))) {
    written.limits.push_back(fmt::format("{} leaves {:.6g} nm RMS{} but {}{} {:.6g} nm", one.file, by_file,
                                         about_zero_in_words(now.residual), programs.front().file,
                                         plan.job.machine ? " on the machine" : "", left));
  }
  if (!first && !feeds) first = FirstExport{std::move(program), now.residual};
  return now;
}

/// Reads the exported programs back from disk.
void check_written_exports(const PlannedJob& plan, const OutputFolder& folder,
                           const std::vector<WrittenProgram>& programs, WrittenPlan& written,
                           const Progress& progress) {
  std::optional<FirstExport> first;
  std::optional<double> unrounded;
  if (has_coarse_controller(plan) && plan.program.motion && !plan.job.options.exports.empty()) {
    unrounded =
        predict_program(plan.part(), run_of(plan, *plan.program.motion, progress), plan.dwell.lattice.kernel, progress)
            .statistics.rms_about_zero();
  }
  std::string before;
  for (const WrittenProgram& one : programs) {
    if (one.word.empty() || one.word == before) continue;  // the first file of a format names the others
    before = one.word;
    const bool any = first.has_value();
    WrittenExport now = check_written_export(plan, folder, one, programs, first, written, progress);
    const double by_file = now.residual.rms_about_zero();
    const bool said = any && by_file == first->residual.rms_about_zero();
    if (unrounded && !said && !says_feeds(plan, one)) say_rounding(one.file, by_file, *unrounded, written);
    written.exports.push_back(std::move(now));
  }
}

/// The share of the weights of the plan without it that a robust plan has.
double share_of_weights(const PlannedJob& plan) {
  const Weights &with = plan.dwell.weights, &without = plan.plain->weights;
  return without.smoothness > 0.0   ? with.smoothness / without.smoothness
         : without.time_price > 0.0 ? with.time_price / without.time_price
                                    : 1.0;
}

/// Of the run of the program as read back; and of that of the plan without `robust plan`, which is in no file.
PlanUncertainty uncertainty_of_plan(const PlannedJob& plan, const Program& run, const Part& part,
                                    const ExactResidual& exact, const Progress& progress) {
  const SampledUncertainty& of = *plan.job.options.uncertainty;
  PlanUncertainty uncertainty =
      uncertainty_of_motion(part, run, plan.dwell.lattice.kernel, exact, of, progress.of_part("uncertainty"));
  uncertainty.dwell_s = plan.dwell.run_dwell();
  if (!plan.plain) return uncertainty;
  const DwellPlan& plain = *plan.plain;
  const Progress without = progress.of_part("uncertainty without the robust plan");
  const bool speeds = plain.motion && plain.motion->program;
  const MachineLimits machine = dwell_options(plan.job).machine;
  const Program program =
      speeds ? *plain.motion->program : program_of(make_machine_program(plan.laid, plain, machine, without).table);
  const Program plain_run = run_of(plan, program, without);
  const ExactResidual left = predict_program(part, plain_run, plain.lattice.kernel, without);
  const ProgramSampler sampler(part, plain_run, plain.lattice.kernel, left.surface, of.unsure, of.seed);
  uncertainty.plain =
      PlainUncertainty{std::sqrt(sampler.nominal_square()), sampler.alone(without),
                       sampler.sample(1, of.samples + 1, without).samples, plain.run_dwell(), share_of_weights(plan)};
  return uncertainty;
}

/// The time that every point gets: with a machine what its motion takes, else what the feed table says.
std::vector<double> dwell_to_write(const PlannedJob& plan) {
  if (!plan.dwell.motion) return plan.program.table.dwell_s;
  return {plan.dwell.motion->seconds.begin(), plan.dwell.motion->seconds.end()};
}

}  // namespace

WrittenPlan write_plan(const PlannedJob& plan, const OutputFolder& folder, const Progress& progress) {
  progress.report("write: feed table and program");
  const std::vector<WrittenProgram> programs = write_program(plan, folder, progress);
  progress.check();

  progress.report("simulate: the program as read back from disk");
  const bool has_table = !says_speeds_alone(plan);
  const std::string file = has_table ? "program.nc" : programs.front().file;
  const Program program = read_back(plan, folder, file, progress);
  WrittenPlan written;
  written.limits = plan.limits();
  const Program run = run_of(plan, program, progress);
  std::optional<Part> changed;
  written.exact = predict_program(part_to_predict_on(plan, changed), run, plan.dwell.lattice.kernel, progress);
  if (!plan.part().beside.values.empty())
    written.beside = shown_surface(plan.part(), written.exact.surface, run, plan.dwell.lattice.kernel);
  if (plan.job.options.uncertainty)
    written.uncertainty = uncertainty_of_plan(plan, run, part_to_predict_on(plan, changed), written.exact, progress);
  write_learnt(plan, folder, program, written);
  if (plan.job.machine) {
    const Machine machine = machine_for_program(plan.job.machine->machine, plan.job.options);
    written.nodes = motion_nodes(program, machine, progress);
    written.binding = binding_limits(written.nodes, machine, dwell_options(plan.job).machine.feed_limits().max_feed);
  }
  if (plan.job.machine && has_table) {  // of others, check_written_exports says it
    for (std::string& fault : beyond_machine(program, plan.job.machine->machine))
      written.limits.push_back(std::move(fault));
  }
  Program table;
  study_surface(plan, written, progress, [&](const Progress& beside) {
    if (has_table) table = read_back(plan, folder, "feed.csv", beside);
  });
  const DwellOptions options = dwell_options(plan.job);
  const double max_feed = options.machine.feed_limits().max_feed;
  written.run_seconds = run.run_seconds(max_feed);
  written.warnings = plan.job.options.notes;
  written.warnings.insert(written.warnings.end(), plan.job.notes.begin(), plan.job.notes.end());
  if (plan.job.lesson) {
    const std::vector<std::string>& notes = plan.job.lesson->notes;
    written.warnings.insert(written.warnings.end(), notes.begin(), notes.end());
  }
  written.travel = travel_times(plan.laid, plan.job.options.lift_height_mm, options.machine);
  written.travel.lifted = program.rapid_seconds(max_feed);  // as simulate reads it
  const bool moves = plan.laid.motion == Motion::Moving;
  for (const std::string& warning :
       run_warnings({written.run_seconds, plan.dwell.run_dwell(), moves ? program.removing_length() : 0.0})) {
    written.warnings.push_back(with_option_names(warning, flag_of));
  }
  if (auto warning = little_gained(plan, plan.part().before, written.exact.statistics)) {
    written.warnings.push_back(std::move(*warning));
  }
  written.program = program_figures(program, written.exact, to_string(plan.part().form), max_feed);
  written.program.seconds = written.run_seconds;  // of the machine's motion, where there is one
  written.program_sha256 = sha256_of_file(folder.path(file));
  compare_with_solver(plan, written);
  if (has_table) compare_with_table(plan, program, table, written, progress);
  check_written_exports(plan, folder, programs, written, progress);
  progress.check();

  progress.report("write: pictures and arrays");
  write_plan_pictures(plan, written, folder, progress);
  write_map(folder.path("residual.npy"), written.shown());
  folder.write("dwell.npy", npy_bytes(std::span<const double>(dwell_to_write(plan))));
  if (plan.dwell.search) folder.write("search.csv", write_trials(*plan.dwell.search));
  written.summary = plan_summary_text(plan, written);
  folder.write("summary.json", written.summary);
  progress.check();
  return written;
}

}  // namespace dwell
