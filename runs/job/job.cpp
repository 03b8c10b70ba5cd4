#include "runs/job/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/errors.h"
#include "core/base/threads.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/map/aperture.h"
#include "paths/domain/keep_out.h"
#include "runs/job/input_files.h"
#include "runs/job/keep_out_option.h"
#include "runs/job/line_profile_map.h"
#include "runs/job/pixel_weight_option.h"
#include "runs/job/program_style.h"
#include "runs/machine/machine_option.h"
#include "runs/plan/pitch_choice.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/shipped_templates.h"

namespace dwell {
namespace {

const PathSpec& required_path(const JobOptions& options) {
  if (!options.path.given())
    throw InputError("--path: required; for instance raster:pitch=1, nearest:cell=2 or file:path.csv");
  return options.path;
}

/// The map of the job, or that of its line profile. Where both files lack a pitch, both are named at once.
HeightMap load_map_of(const JobOptions& options, Job& job, const Progress& progress) {
  if (!options.line_profile.empty()) return load_line_profile(options, job.inputs, job.notes, progress);
  try {
    return load_map(options, job.inputs, progress);
  } catch (const MissingPitch&) {
    const std::vector<std::string> missing = missing_pitches(options);
    if (missing.size() < 2) throw;
    throw InputError(
        fmt::format("{}: required [mm] > 0; there is no pixel pitch in the map {}, nor in the removal function {}",
                    fmt::join(missing, ", "), surface_file(options), options.tif));
  }
}

/// The limits of --accept; `mid` is of this tool.
std::vector<SurfaceLimit> limits_to_accept(const JobOptions& options, const RemovalFunction& tif) {
  if (options.accept.empty()) return {};
  try {
    return parse_surface_limits(options.accept, tool_band_edges(tif.fwhm));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--accept: {}", error.what()));
  }
}

/// Says so where an absolute removal is below zero.
void note_negative_removal(const Part& part, JobOptions& options) {
  if (options.removal.empty() && !options.piston_nm) return;
  if (part.form.piston) return;
  Index below = 0;
  double least = 0.0;
  for (const double depth : part.map.values) {
    if (!(depth < 0.0)) continue;
    ++below;
    least = std::min(least, depth);
  }
  if (below == 0) return;
  options.notes.push_back(fmt::format(
      "the depth to remove is below 0 at {} of {} pixels, down to {:.4g} nm: no tool adds material, so that "
      "these stay low; --piston raises all",
      below, part.before.valid_pixels, least));
}

/// Lines of G-code from the file of an option, if it is given.
GcodeInsert load_insert(const char* role, const std::string& file, std::vector<InputFile>& inputs) {
  if (file.empty()) return {};
  inputs.push_back({role, file, sha256_of_file(file)});
  return read_gcode_insert(file);
}

}  // namespace

DwellOptions dwell_options(const JobOptions& o) {
  DwellOptions options{{o.min_dwell_s, o.max_feed_mm_per_min, std::nullopt},
                       o.smoothness,
                       o.time_price_nm2_per_s,
                       o.time_worth,
                       o.solver,
                       o.max_solve_s};
  options.certify = o.certify;
  options.fraction = o.fraction;
  options.objective = o.objective;
  options.rounds = o.rounds;
  options.schedule = o.schedule;
  options.over_path = has_export_over_path(o.exports);
  return options;
}

void check_weights(const JobOptions& options) {
  DwellOptions checked = dwell_options(options);
  if (options.robust_plan) {
    if (!options.uncertainty) {
      throw InputError(
          "`robust plan` without `uncertainty`: it is that which it is robust against; required "
          "`uncertainty`, as tif-rate=5%,position=20um");
    }
    checked.robust = options.uncertainty->unsure;
  }
  check_weights(checked);
}

DwellOptions dwell_options(const Job& job) {
  DwellOptions options = dwell_options(job.options);
  if (job.machine) options.machine.machine = machine_for_program(job.machine->machine, job.options);
  if (job.lesson) options.machine.learnt = std::make_shared<const LearntMotion>(job.lesson->run.learnt);
  return options;
}

Job load_job(const JobOptions& options, const Progress& progress) {
  check_profile_options(options);
  Job job;
  job.options = options;
  if (!options.machine.empty()) {
    job.machine = machine_of_option(options.machine);
    if (!is_inline_machine(options.machine))
      job.inputs.push_back({"machine", options.machine, sha256_of_file(options.machine)});
  }
  job.keep_out = load_keep_out(options.keep_out, job.inputs);
  job.header = load_insert("header", options.header, job.inputs);
  job.footer = load_insert("footer", options.footer, job.inputs);
  check_program_style(options, job.machine, job.header, job.footer);
  if (!options.program_template.empty()) {
    const std::string text = program_template_text(options.program_template);
    job.inputs.push_back({"template", options.program_template, sha256_of(text)});
    job.layout = parse_program_template(text, options.program_template);
  }
  HeightMap map = load_map_of(options, job, progress);
  job.map_pixels = map.valid_pixels();
  map = within(std::move(map), options.aperture, progress);
  progress.check();
  std::vector<double> weights = load_pixel_weights(options.weight, options.clear_aperture, map, surface_file(options),
                                                   thread_count(options.threads), job.inputs);
  RemovalFunction tif = load_removal_function(options, job.inputs, progress);
  job.part = std::make_shared<const Part>(
      make_part(std::move(map), std::move(tif), form_terms(options), options.threads, progress, std::move(weights)));
  job.accept = limits_to_accept(options, job.part->tif);
  note_negative_removal(*job.part, job.options);
  return job;
}

JobPath lay_job_path(const Job& job, double used_seconds, const Progress& progress) {
  DwellOptions options = dwell_options(job);
  options.used_seconds = used_seconds;
  const PathSpec& spec = required_path(job.options);
  if (pitch_is_searched(spec)) {
    if (!job.keep_out.empty()) {
      throw InputError(
          "--keep-out: together with a raster whose pitch is searched (--path raster:pitch=auto); required a pitch");
    }
    SearchedRaster found = lay_searched_raster(*job.part, spec, job.options.motion, options, progress);
    return {std::move(found.laid), std::move(found.dwell)};
  }
  LaidPath laid = time_limit(options.max_seconds, used_seconds).run(progress, [&](const Progress& limited) {
    LaidPath whole = lay_path(*job.part, spec, job.options.motion, options.machine.feed_limits().max_feed, limited);
    if (job.keep_out.empty()) return whole;
    limited.step("path: keeping out of zones");
    return lay_path(keep_out_of(whole.path, whole.motion, job.keep_out).path, whole.motion);
  });
  return {std::move(laid), std::nullopt};
}

std::optional<InputFile> path_input(const JobOptions& options) {
  const auto* file = required_path(options).get_if<PathFromFile>();
  if (!file) return std::nullopt;
  return InputFile{"path", file->file.string(), sha256_of_file(file->file)};
}

}  // namespace dwell
