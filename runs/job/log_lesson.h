#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"
#include "runs/logs/log_alignment.h"
#include "runs/logs/motion_log.h"
#include "runs/machine/machine_file.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/learnt_motion.h"
#include "runs/plan/part.h"

namespace dwell {

/// What the log of an earlier plan's run teaches for this one.
struct LogLesson {
  MotionLog log;
  Program program;  // of the earlier plan, as it is on disk
  AlignedLog aligned;
  LearntFromRun run;
  std::vector<std::string> notes;  // a sentence each
};

/// Throws InputError, before any work, for options about a log that cannot be used together.
void check_log_options(const JobOptions& options);

/// SHA-256 of all that is known of a machine, however its file says it.
std::string sha256_of_machine(const NamedMachine& machine);

/// Reads the log of the options and lays it on the program of their `log plan`; nothing where there is no log. What
/// that plan has learnt itself is added to, if its machine was the same. `as_planned`: the machine with its axes and
/// corners as the program has them. The files read are appended to `inputs`. Throws InputError for a log of another
/// path and for a program that is not of the laid path, Interrupted. Cost: align_log and learn_motion.
std::optional<LogLesson> learn_from_log(const JobOptions& options, const Part& part, const LaidPath& laid,
                                        const NamedMachine& machine, const Machine& as_planned,
                                        std::vector<InputFile>& inputs, const Progress& progress);

}  // namespace dwell
