#include "runs/figure/store/plan_step.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/learnt_frame.h"
#include "runs/figure/setup_sheet.h"
#include "runs/figure/store/kept_inputs.h"
#include "runs/figure/store/step_records.h"
#include "runs/job/job_file.h"
#include "runs/job/place_option.h"
#include "runs/job/program_style.h"
#include "runs/reports/plan_output.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

Json uncertainty_record(const RunUncertainty& unsure) {
  return {
      {"rate", unsure.rate}, {"width", unsure.width}, {"shift_mm", unsure.shift}, {"rotation_mrad", unsure.rotation}};
}

Json record_of(const PlannedStep& step, const FigureState& state) {
  const PlannedJob& plan = step.target.plan;
  const JobOptions& o = plan.job.options;
  return {{"map_step", state.map_step},
          {"program", {{"file", step.written.program.file}, {"sha256", step.written.program_sha256}}},
          {"before", statistics_record(plan.part().before)},
          {"predicted", statistics_record(step.written.exact.statistics)},
          {"dwell_s", plan.dwell.run_dwell()},
          {"run_s", step.written.run_seconds},
          {"margin_nm", step.target.expected.margin},
          {"uncertainty", uncertainty_record(state.uncertainty())},
          {"target", state.target},
          {"reaches", step.target.reaches},
          {"verdicts", verdict_records(step.verdicts)},
          {"choice", step.target.sentence},
          {"tool", {{"rate", o.tif_rate}, {"width", o.tif_width}}},
          {"frame", {{"zero_mm", {o.zero_mm.x, o.zero_mm.y}}, {"rotate_deg", o.rotate_deg}}},
          {"limits", step.written.limits},
          {"warnings", step.written.warnings},
          {"advice", step.written.advice}};
}

/// Programs of places of the part cannot make up for where the machine removed.
void check_frame(const JobOptions& options, const FigureState& state) {
  const std::string why = why_frame_is_fixed(options);
  if (why.empty() || program_frame(options) == state.as_set_up) return;
  throw InputError(fmt::format(
      "{}, and the run has learnt that the machine removes elsewhere than it is told (zero {}, turned by {:.4g} "
      "degrees): required another export, or --zero {} --rotate {:g} with the part moved on the machine",
      why, to_string(options.zero_mm), options.rotate_deg, to_string(state.as_set_up.zero()),
      state.as_set_up.degrees()));
}

}  // namespace

PlannedStep add_plan(RunFolder& run, const FigureState& state, const JobOptions& options, const Progress& progress) {
  const int iteration = state.runs + 1;
  const std::filesystem::path place = run.path_of_next(step_kinds::kPlan, iteration);
  JobOptions own = options;
  own.out = place.string();
  run.require_unchanged(run.step(1));
  run.require_unchanged(run.step(state.map_step));
  check_frame(own, state);
  check_exports(own);
  const Job job = load_job(own, progress);
  PlannedStep step;
  step.folder = place.string();
  step.target = plan_for_target(job, state.limits, state.uncertainty(), progress);
  const auto write = [&](const OutputFolder& folder) {
    step.written = write_plan(step.target.plan, folder, progress);
    JobOptions kept = options_seen_from(step.target.plan.job.options, "", place);
    kept.out.clear();
    folder.write("job.toml", job_file_text(kept));
    const SetupSheet sheet = setup_sheet(step.target.plan, step.written, iteration, state.as_set_up);
    step.setup = sheet.text();
    folder.write("setup.txt", step.setup);
    folder.write("setup.pdf", setup_picture(sheet, step.target.plan, FigureFormat::Pdf));
    // The program as read back, from the removal function itself, has the last word.
    step.verdicts = judge_with_margin(step.written.exact.surface, step.target.expected.changes, step.target.plan.part(),
                                      state.limits, progress);
    if (!state.limits.empty()) step.target.reaches = all_pass(step.verdicts);
    if (!step.target.reaches && !state.limits.empty())
      step.written.limits.emplace_back("the target is not expected to be met: " + step.target.sentence);
    return record_of(step, state);
  };
  run.append(step_kinds::kPlan, iteration, write);
  return step;
}

}  // namespace dwell
