#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"

namespace dwell::cli {

/// Exit codes of the program (docs/formats.md, "Exit codes").
enum ExitCode : int { kDone = 0, kInternalFault = 1, kBadInput = 2, kLimitReached = 3, kInterrupted = 130 };

/// Progress on standard error (progress_line.h); stops on SIGINT, SIGTERM and SIGHUP.
Progress terminal_progress();

/// Says on standard error that the run was interrupted, once however often it is called.
void say_interrupted();

/// Keeps interrupts waiting until catch_interrupts(), also across a new start of the program: first thing in main.
void hold_interrupts();

/// Installs the handlers that make a run stop cleanly: what works is asked to stop (Progress), and if the process has
/// not ended 0.1 s later it is ended, with nothing left of what was not yet a result.
void catch_interrupts();

/// From here on an interrupt changes nothing: the answer is out, and all that is left is to end.
void ignore_interrupts();

/// Says on standard error which limits were reached. Gives back the exit code of the command.
int say_limits(const std::vector<std::string>& limits);

}  // namespace dwell::cli
