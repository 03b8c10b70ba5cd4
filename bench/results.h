#pragma once

#include <nlohmann/json.hpp>

#include "bench/machine.h"
#include "bench/micro.h"

namespace dwell::bench {

nlohmann::json to_json(const Computer& machine);
nlohmann::json to_json(const MicroResult& result);

/// The results of a part as a Markdown table: of run_micro, run_certificates, run_plans.
std::string micro_table(const nlohmann::json& micro);
std::string certificate_table(const nlohmann::json& certificates);
std::string plan_table(const nlohmann::json& plans);
/// Of run_plans: udo-raster with and without what no tool reaches.
std::string blemish_table(const nlohmann::json& plans);

}  // namespace dwell::bench
