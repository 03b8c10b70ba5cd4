#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/value_range.h"

namespace dwell::cli {

/// Adds an option that takes a number within a range. What is none is refused with the option, its value and what is
/// accepted. `into` must live until the command line is parsed.
CLI::Option* add_number(CLI::App& command, const std::string& flag, double& into, const ValueRange& range,
                        const std::string& help);
CLI::Option* add_number(CLI::App& command, const std::string& flag, std::optional<double>& into,
                        const ValueRange& range, const std::string& help);

/// The same for a whole number from 0 to 2^53, which a double holds exactly.
CLI::Option* add_whole_number(CLI::App& command, const std::string& flag, std::uint64_t& into, const std::string& help);

}  // namespace dwell::cli
