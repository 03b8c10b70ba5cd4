#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "core/motion/program.h"
#include "runs/logs/log_alignment.h"
#include "runs/logs/machine_fit.h"
#include "runs/logs/motion_log.h"
#include "runs/machine/machine_file.h"

namespace dwell {

/// A log and how it lies on its program, in lines for people.
std::string log_lines(const MotionLog& log, const AlignedLog& aligned, const Program& program);

/// The same in JSON (docs/json.md). Units in the keys.
nlohmann::ordered_json log_block(const MotionLog& log, const AlignedLog& aligned);

/// A machine that was fitted to a log, in lines for people, the machine itself last.
std::string fit_lines(const MachineFit& fit, const NamedMachine& machine);

/// Of `dwell machine fit`: figures, what is not determined, how well, and the machine.
nlohmann::ordered_json fit_block(const MachineFit& fit);

}  // namespace dwell
