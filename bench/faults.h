#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dwell::bench {

/// What is wrong with the solves of a run, a sentence each: `auto` not within 1 % of a reference, a peer there with
/// fewer operator pairs, a scenario without a settled reference. Counts work, not seconds, so that a busy machine is no
/// fault; scenarios of under a thousand dwell points say nothing about a method.
std::vector<std::string> faults_of(const nlohmann::json& all);

}  // namespace dwell::bench
