#pragma once

#include <nlohmann/json.hpp>

#include "bench/machine.h"
#include "bench/micro.h"

namespace dwell::bench {

nlohmann::json to_json(const Machine& machine);
nlohmann::json to_json(const MicroResult& result);

/// The micro results as a Markdown table.
std::string micro_table(const nlohmann::json& micro);

}  // namespace dwell::bench
