#include "runs/figure/store/measured_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/errors.h"
#include "core/form/robust_pv.h"
#include "core/formats/map_io.h"
#include "core/formats/map_name.h"
#include "core/map/aperture.h"
#include "paths/feed/execution.h"
#include "paths/feed/lift_rests.h"
#include "runs/base/json_blocks.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/picture.h"
#include "runs/drawing/plot_field.h"
#include "runs/figure/learnt_frame.h"
#include "runs/figure/store/kept_inputs.h"
#include "runs/figure/store/step_records.h"
#include "runs/job/input_files.h"
#include "runs/job/job.h"
#include "runs/job/job_file.h"
#include "runs/job/program_style.h"
#include "runs/logs/log_file.h"
#include "runs/map_steps/map_steps.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/shipped_templates.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The plan that was run, with its inputs.
struct PlanThatRan {
  JobOptions options;
  Job job;
  Program program;
};

PlanThatRan plan_that_ran(const RunFolder& run, const RunStep& step, int threads, const Progress& progress) {
  PlanThatRan plan;
  const fs::path place = run.path_of(step);
  read_job_file(place / "job.toml", plan.options);
  plan.options.threads = threads;
  const Json& record = step.content.at("program");
  const std::string name = record.at("file");
  const fs::path file = place / name;
  plan.job = load_job(without_program_style(plan.options), progress);
  GcodeReading reading;
  if (plan.job.machine) reading.letters = plan.job.machine->machine.letters;
  if (fs::path(name).stem() == kTemplateProgram) reading.layout = find_program_template(plan.options.program_template);
  plan.program = read_program(file, reading, progress);
  return plan;
}

/// The motion that was simulated, and the one that a log has.
MeasuredRun motions_of(const PlanThatRan& plan, const std::optional<LogSource>& log, const Progress& progress) {
  MeasuredRun run;
  const auto& machine = plan.job.machine;
  run.motion = machine ? execute(plan.program, machine->machine, progress).motion : plan.program;
  if (!log) return run;
  const MotionLog recorded = read_motion_log(log->file, log->reading, progress);
  const AlignedLog aligned = align_log(recorded, plan.program, log->tolerance, progress);
  run.recorded =
      with_lift_rests(recorded_motion(recorded, aligned, plan.program), machine ? machine->machine : Machine{});
  return run;
}

/// The options by which the map after the run is read.
JobOptions map_options(const Measurement& measurement) {
  JobOptions options = measurement.map;
  if (!measurement.steps_of_this_map.empty())
    options.map_steps += (options.map_steps.empty() ? "" : ";") + measurement.steps_of_this_map;
  return options;
}

std::string triple_picture(const MeasuredStep& step, const Progress& progress) {
  const RemovalComparison& c = step.comparison;
  std::vector<MapPanel> panels;
  for (const auto& [map, title] : {std::pair(&c.predicted, "to be removed"), std::pair(&c.measured, "removed"),
                                   std::pair(&c.unexplained, "not explained by tool and place")}) {
    MapPanel panel;
    panel.field = field_of_map(*map, field_edges(3), progress);
    panel.colours = ColourMap::Diverging;
    panel.limits = colour_limits(map->values, ColourMap::Diverging);
    panel.title = title, panel.unit = "nm";
    panels.push_back(std::move(panel));
  }
  return draw_maps(fmt::format("Run {}: removal, form terms removed", step.iteration), panels, FigureFormat::Png).bytes;
}

/// `kept`: the map's options with the names of the files in the step. Steps of this map alone are behind the others.
Json record_of(const MeasuredStep& step, int plan_step, const JobOptions& kept, std::size_t remembered) {
  const Json learnt{{"tif_rate", step.next.tif_rate},
                    {"tif_width", step.next.tif_width},
                    {"zero_mm", {step.next.zero_mm.x, step.next.zero_mm.y}},
                    {"rotate_deg", step.next.rotate_deg}};
  Json record{{"plan_step", plan_step},
              {"map_options", option_records(kept, is_map_convention)},
              {"map_steps_remembered", remembered},
              {"before", statistics_record(step.before)},
              {"predicted", statistics_record(step.predicted)},
              {"after", statistics_record(step.after)},
              {"run_s", step.seconds},
              {"covered", step.comparison.covered},
              {"warnings", step.warnings},
              {"convergence", finite_or_null(step.convergence())},
              {"efficiency", finite_or_null(step.efficiency())},
              {"surface", surface_block(step.surface)},
              {"lesson", lesson_record(step.lesson)},
              {"learnt", learnt},
              {"next_run", next_run_record(step.next_run)}};
  record.update(comparison_record(step.comparison));
  return record;
}

void write_files(const MeasuredStep& step, const HeightMap& map, const Part& part, const OutputFolder& folder,
                 const Progress& progress) {
  write_map(folder.path("map.npy"), map);
  write_map(folder.path("removed.npy"), step.comparison.measured);
  write_map(folder.path("to_be_removed.npy"), step.comparison.predicted);
  write_map(folder.path("unexplained.npy"), step.comparison.unexplained);
  const std::string title =
      fmt::format("After run {}: {} ({} removed)", step.iteration, in_words(step.after), to_string(part.form));
  folder.write("after.png", after_picture(part.figure, without_form(step.comparison.after, part.form, part.threads),
                                          FigureRange::Shared, title, FigureFormat::Png, progress));
  folder.write("removal.png", triple_picture(step, progress));
}

/// The options of the next plan: what was learnt is of tool and frame as the plan had them.
JobOptions next_options(const FigureState& state, const JobOptions& planned, const MeasuredStep& step,
                        const JobOptions& map) {
  JobOptions next = state.options;
  next.tif_rate = planned.tif_rate, next.tif_width = planned.tif_width;
  next.zero_mm = planned.zero_mm, next.rotate_deg = planned.rotate_deg;
  return with_map_of(with_learnt(next, step.lesson, step.comparison.registration.about), map);
}

/// The plan whose program was run: the last for the present map, or one of that map that is named.
std::optional<int> plan_of(const RunFolder& run, const FigureState& state, const Measurement& measurement) {
  if (!measurement.plan_step) return state.plan_step;
  const int number = *measurement.plan_step;
  std::string accepted;
  for (const RunStep& step : run.steps()) {
    if (step.kind != step_kinds::kPlan || step.content.at("map_step") != state.map_step) continue;
    if (step.number == number) return number;
    accepted += fmt::format("{}{}", accepted.empty() ? "" : ", ", step.number);
  }
  throw InputError(fmt::format("{}: step {} is no plan for the map that the part has now; accepted: {}",
                               run.folder().string(), number, accepted.empty() ? "none" : accepted));
}

/// Says so where hardly anything was removed: then nothing can be learnt, and the map is mostly the one before.
std::string nothing_removed(const RemovalComparison& comparison, const Part& part) {
  const double predicted = map_statistics(comparison.predicted, part.form, part.threads).rms_about_zero();
  const double measured = comparison.registration.measured_rms;
  constexpr double kNothing = 0.05;
  if (measured >= kNothing * predicted) return "";
  return fmt::format(
      "next to nothing was removed: {:.3g} nm RMS where {:.4g} were to be; is this the map from before the run, or was "
      "the program not run?",
      measured, predicted);
}

/// Says so where what was removed has next to nothing to do with what was to be.
std::string unrelated(const RemovalComparison& comparison) {
  const double measured = comparison.registration.measured_rms, unexplained = comparison.split.unexplained;
  constexpr double kUnrelated = 0.8;
  if (unexplained <= kUnrelated * measured) return "";
  return fmt::format(
      "{:.4g} of {:.4g} nm RMS that were removed have nothing to do with what was to be removed: is this the map of "
      "this "
      "part, in the unit that is taken for it, and was it this program that was run (--plan N)?",
      unexplained, measured);
}

LessonPolicy policy_of(const Measurement& measurement, const FigureState& state, const PlanThatRan& plan,
                       const MeasuredStep& step) {
  LessonPolicy policy = measurement.policy;
  constexpr double kUsualChange = 0.05;  // of a tool's rate from run to run
  if (!state.lessons.empty()) policy.expected_rate_change = kUsualChange;
  const std::string why = why_frame_is_fixed(plan.options);
  if (why.empty()) return policy;
  for (const LessonSubject subject : policy.taken) {
    if (subject == LessonSubject::Shift || subject == LessonSubject::Rotation)
      throw InputError(fmt::format("--learn shift=take, rotation=take: {}; required leave", why));
  }
  const RemovalRegistration& r = step.comparison.registration;
  policy.fixed = fmt::format("{}; move the part by ({:.3f}, {:.3f}) mm and {:.4g} degrees on the machine", why,
                             r.x.value, r.y.value, r.degrees.value);
  return policy;
}

std::vector<std::string> warnings_of(const MeasuredStep& step) {
  std::vector<std::string> warnings;
  const RemovalComparison& c = step.comparison;
  constexpr double kWhole = 0.9, kHalf = 0.5, kScale = 3e-3;
  if (!(c.covered >= kWhole)) {
    warnings.push_back(fmt::format(
        "the map has only {:.3g} % of the part's pixels before: the next plan is of these alone", 100.0 * c.covered));
  }
  if (!(c.split.unexplained <= kHalf * c.registration.measured_rms)) {
    warnings.push_back(
        fmt::format("{:.4g} of {:.4g} nm RMS that were removed are not explained by tool and place: look at "
                    "removal.png before anything is made of it",
                    c.split.unexplained, c.registration.measured_rms));
  }
  if (!(step.after.rms_about_zero() >= kHalf * step.predicted.rms_about_zero())) {
    warnings.push_back(
        fmt::format("{:.4g} nm RMS are left, less than half of the {:.4g} that were predicted: is the unit of "
                    "the map right?",
                    step.after.rms_about_zero(), step.predicted.rms_about_zero()));
  }
  const Estimate& scale = c.registration.scale;
  if (std::abs(scale.value - 1.0) > std::max(kScale, 3.0 * scale.error)) {
    warnings.push_back(
        fmt::format("what was removed is {:.5g} +- {:.1g} times as large as it was meant to be: the pixel "
                    "pitch of a map or the machine's scale is off",
                    scale.value, scale.error));
  }
  return warnings;
}

}  // namespace

std::optional<double> MeasuredStep::efficiency() const {
  const double foreseen = before.rms_about_zero() - predicted.rms_about_zero();
  if (!(foreseen > 0.0)) return {};
  return (before.rms_about_zero() - after.rms_about_zero()) / foreseen;
}

MeasuredStep add_measurement(RunFolder& run, const FigureState& state, const Measurement& measurement,
                             const Progress& progress) {
  const std::optional<int> plan_step = plan_of(run, state, measurement);
  if (!plan_step) {
    throw InputError(fmt::format("{}: no plan waits for a measurement; dwell figure plan {} makes the next",
                                 run.folder().string(), run.folder().string()));
  }
  const RunStep& planned = run.step(*plan_step);
  for (const int step : std::set<int>{1, state.map_step, *plan_step}) run.require_unchanged(run.step(step));
  const PlanThatRan plan = plan_that_ran(run, planned, measurement.threads, progress.of_part("plan"));
  const Part& part = *plan.job.part;
  const JobOptions own = map_options(measurement);
  std::vector<InputFile> inputs;
  HeightMap map = within(load_map(own, inputs, progress), plan.options.aperture, progress);
  MeasuredRun measured = motions_of(plan, measurement.log, progress);
  measured.after = map;
  measured.orientation_is_known = measurement.orientation_is_known;
  MeasuredStep step;
  step.iteration = planned.iteration;
  step.comparison = compare_removal(part, measured, progress.of_part("compare"));
  step.before = part.before;
  step.predicted = statistics_of_record(planned.content.at("predicted"));
  step.after = with_robust_pv(map_statistics(map, part.form, part.threads), without_form(map, part.form, part.threads),
                              part.threads);
  step.seconds = planned.content.at("run_s");
  step.fault = measurement.orientation_is_known ? "" : step.comparison.orientation.fault;
  if (step.fault.empty()) step.fault = nothing_removed(step.comparison, part);
  if (step.fault.empty() && !measurement.orientation_is_known) step.fault = unrelated(step.comparison);
  if (!step.fault.empty()) return step;
  step.lesson = learn_from(step.comparison.registration, part.tif.fwhm, policy_of(measurement, state, plan, step));
  step.fault = step.lesson.orientation_fault;
  if (!step.fault.empty()) return step;
  step.warnings = warnings_of(step);
  step.surface = surface_sheet(part.figure, without_form(step.comparison.after, part.form, part.threads), part.tif.fwhm,
                               part.threads, progress);
  step.next = next_options(state, plan.options, step, own);
  std::vector<ToolLesson> lessons = state.lessons;
  lessons.push_back(step.lesson);
  step.next.threads = measurement.threads;
  step.next_run = look_at_next_run(step.next, state.limits, uncertainty_after(lessons), progress);
  step.folder = run.path_of_next(step_kinds::kMeasured, step.iteration).string();
  progress.step("writing");
  run.append(step_kinds::kMeasured, step.iteration, [&](const OutputFolder& folder) {
    const JobOptions kept = keep_inputs(own, folder, "map");
    write_files(step, map, part, folder, progress);
    Json record = record_of(step, *plan_step, kept, parse_map_steps(measurement.map.map_steps).size());
    record["log"] =
        measurement.log ? Json(keep_file(split_map_name(measurement.log->file).file, "log", folder)) : Json(nullptr);
    return record;
  });
  return step;
}

}  // namespace dwell
