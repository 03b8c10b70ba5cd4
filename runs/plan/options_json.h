#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/plan/plan.h"

namespace dwell {

/// The "options" of a summary: every option in force by its job-file key, as text.
inline nlohmann::ordered_json options_json(const Plan& plan) {
  auto options = nlohmann::ordered_json::object();
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.key == "out") continue;  // where a plan lies is not part of what it is
    const std::string value = record.get(plan.options);
    if (!value.empty()) options[record.key] = value;
  }
  options["threads"] = std::to_string(plan.threads);
  return options;
}

}  // namespace dwell
