#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "paths/feed/lift_rests.h"
#include "runs/machine/machine_file.h"

namespace dwell {

/// A machine in lines for people: name, axes, path, corners, and what a stop costs.
std::string machine_lines(const NamedMachine& machine);

/// The rests at the lifts of a run, for people; empty where the machine makes none.
std::string lift_words(const LiftTotals& totals);

/// The same in JSON (docs/json.md).
nlohmann::ordered_json lift_block(const LiftTotals& totals);

/// A machine in JSON (docs/json.md); null where there is no limit. Units in the keys.
nlohmann::ordered_json machine_block(const NamedMachine& machine);

/// Of a command that shows a machine: head and block.
std::string machine_json(const NamedMachine& machine, const std::string& file);

}  // namespace dwell
