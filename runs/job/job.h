#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/map/aperture.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"
#include "runs/job/log_lesson.h"
#include "runs/machine/machine_file.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"
#include "runs/programs/gcode_insert.h"
#include "runs/programs/program_template.h"

namespace dwell {

/// What a user asked for, with its files read: the values that a plan is made from. Copies share the part.
struct Job {
  JobOptions options;
  std::vector<InputFile> inputs;  // all files read
  Index map_pixels = 0;           // valid pixels of the map before the aperture
  std::shared_ptr<const Part> part;
  std::optional<NamedMachine> machine;
  std::vector<Aperture> keep_out;         // that the path spares
  GcodeInsert header, footer;             // of program.nc
  std::optional<ProgramTemplate> layout;  // of one more program
  std::optional<LogLesson> lesson{};      // of the log, once the path is laid
  std::vector<SurfaceLimit> accept{};     // that the surface is judged by
  std::vector<std::string> notes{};       // what reading the files has to say, a sentence each
};

/// Reads map and removal function and makes the part; the path is not looked at. Throws InputError naming flag or file,
/// Interrupted.
Job load_job(const JobOptions& options, const Progress& progress = {});

/// The path of a job, laid on the part.
struct JobPath {
  LaidPath laid;
  std::optional<DwellPlan> dwell;  // of it, where laying it has found that as well (SearchedRaster)
};

/// The path of a job, planned or read from its file. `used_seconds` of the time limit went before. Throws InputError,
/// TimeLimitReached, Interrupted.
JobPath lay_job_path(const Job& job, double used_seconds = 0.0, const Progress& progress = {});
/// The file that the path of these options comes from, if it does, with its hash.
std::optional<InputFile> path_input(const JobOptions& options);

/// What of the options the dwell and the machine depend on; without the machine of a file.
DwellOptions dwell_options(const JobOptions& options);
/// The same with the machine of the job.
DwellOptions dwell_options(const Job& job);

/// check_weights of a job, and of its robust plan. Throws InputError for one without an uncertainty as well.
void check_weights(const JobOptions& options);

}  // namespace dwell
