#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/machine/machine_file.h"

namespace dwell {

/// A machine in lines for people: name, axes, path, corners, and what a stop costs.
std::string machine_lines(const NamedMachine& machine);

/// A machine in JSON (docs/json.md); null where there is no limit. Units in the keys.
nlohmann::ordered_json machine_block(const NamedMachine& machine);

/// Of a command that shows a machine: head and block.
std::string machine_json(const NamedMachine& machine, const std::string& file);

}  // namespace dwell
