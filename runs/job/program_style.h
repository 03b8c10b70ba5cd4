#pragma once

#include <optional>

#include "core/motion/program_frame.h"
#include "runs/job/job_options.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/gcode_insert.h"
#include "runs/programs/gcode_style.h"

namespace dwell {

/// How program.nc lies against the part.
ProgramFrame program_frame(const JobOptions& options);

/// The machine as a plan sees it: its axes as program.nc has them, its corners as the program asks for them.
Machine machine_for_program(const Machine& machine, const JobOptions& options);

/// How program.nc is written. `before`, `after`: the lines of --header and --footer.
GcodeStyle gcode_style(const JobOptions& options, const std::optional<NamedMachine>& machine, const GcodeInsert& before,
                       const GcodeInsert& after);

/// Refuses what cannot be written so, before anything is computed: a path mode of which the machine's motion cannot be
/// planned, lines of G-code with which our reader refuses the program. Throws InputError naming both options, or file
/// and line.
void check_program_style(const JobOptions& options, const std::optional<NamedMachine>& machine,
                         const GcodeInsert& before, const GcodeInsert& after);

/// The options of a plan for simulating its program, which holds what they said of how it is written.
JobOptions without_program_style(JobOptions options);

}  // namespace dwell
