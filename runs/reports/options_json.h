#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/job/job.h"

namespace dwell {

/// The "options" of a summary: every option in force by its job-file key, as text.
inline nlohmann::ordered_json options_json(const Job& job) {
  auto options = nlohmann::ordered_json::object();
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.key == "out") continue;  // where a plan lies is not part of what it is
    const std::string value = record.get(job.options);
    if (!value.empty()) options[record.key] = value;
  }
  options["threads"] = std::to_string(job.part->threads);
  return options;
}

}  // namespace dwell
