#include "runs/figure/store/figure_state.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"
#include "core/spectra/wavelength_bands.h"
#include "runs/figure/store/kept_inputs.h"
#include "runs/figure/store/step_records.h"
#include "runs/job/job_file.h"
#include "runs/job/program_style.h"
#include "runs/map_steps/map_steps.h"

namespace dwell {
namespace {

std::set<int> withdrawn_steps(const RunFolder& run) {
  std::set<int> withdrawn;
  for (const RunStep& step : run.steps()) {
    if (step.kind == step_kinds::kWithdrawn) withdrawn.insert(step.content.at("step").get<int>());
  }
  return withdrawn;
}

void begin(const RunFolder& run, const RunStep& step, FigureState& state) {
  read_job_file(run.path_of(step) / "job.toml", state.options);
  state.conventions = with_map_of(JobOptions(), state.options);
  state.as_set_up = program_frame(state.options);
  state.target = step.content.at("target");
  const std::string bands = step.content.at("bands");
  state.limits = limits_of_target(state.target, bands);
}

std::string first_steps(const std::string& steps, std::size_t count) {
  std::string text;
  std::vector<MapStep> all = parse_map_steps(steps);
  for (std::size_t k = 0; k < std::min(count, all.size()); ++k) text += (k > 0 ? "; " : "") + to_string(all[k], false);
  return text;
}

/// The map of a measurement, as its instrument writes it, and what was learnt by it.
void take_measurement(const RunFolder& run, const RunStep& step, FigureState& state) {
  const std::string source = step.folder;
  JobOptions read;
  set_options_of_records(read, step.content.at("map_options"), source);
  read = options_seen_from(read, run.path_of(step), "");
  state.options = with_map_of(state.options, read);
  state.conventions = with_map_of(JobOptions(), read);
  state.conventions.map_steps = first_steps(read.map_steps, step.content.at("map_steps_remembered"));
  const nlohmann::ordered_json& learnt = step.content.at("learnt");
  state.options.tif_rate = learnt.at("tif_rate"), state.options.tif_width = learnt.at("tif_width");
  state.options.zero_mm = {learnt.at("zero_mm").at(0), learnt.at("zero_mm").at(1)};
  state.options.rotate_deg = learnt.at("rotate_deg");
  state.lessons.push_back(lesson_of_record(step.content.at("lesson")));
  ++state.runs;
  state.map_step = step.number;
  state.plan_step.reset();
}

}  // namespace

bool is_map_convention(const std::string& key) {
  return key == "map" || key.starts_with("map_") || key == "wavelength_nm" || key == "wave_scale";
}

JobOptions with_map_of(const JobOptions& options, const JobOptions& map) {
  JobOptions merged;
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string value = record.get(is_map_convention(record.key) ? map : options);
    if (!value.empty()) set_job_option(merged, record, value, "--" + record.flag);
  }
  return merged;
}

std::vector<SurfaceLimit> limits_of_target(const std::string& target, const std::string& bands) {
  if (target.empty()) return {};
  return parse_surface_limits(target, bands.empty() ? std::vector<double>() : parse_band_edges(bands));
}

FigureState figure_state(const RunFolder& run) {
  FigureState state;
  state.withdrawn = withdrawn_steps(run);
  for (const RunStep& step : run.steps()) {
    if (state.withdrawn.contains(step.number)) continue;
    try {
      if (step.kind == step_kinds::kNew) {
        begin(run, step, state);
      } else if (step.kind == step_kinds::kPlan) {
        if (step.content.at("map_step") == state.map_step) state.plan_step = step.number;
      } else if (step.kind == step_kinds::kMeasured) {
        take_measurement(run, step, state);
      } else if (step.kind != step_kinds::kWithdrawn) {
        throw InputError(fmt::format("{}: a step of kind '{}' is not known to this version of dwell",
                                     run.path_of(step).string(), step.kind));
      }
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: step.json: {}", run.path_of(step).string(), error.what()));
    }
  }
  return state;
}

}  // namespace dwell
