#pragma once

#include <nlohmann/json.hpp>

#include <vector>

#include "runs/base/input_file.h"

namespace dwell {

/// The "inputs" of a summary: role, file and SHA-256 of every file read.
inline nlohmann::ordered_json inputs_json(const std::vector<InputFile>& inputs) {
  auto list = nlohmann::ordered_json::array();
  for (const InputFile& input : inputs) {
    list.push_back({{"role", input.role}, {"file", input.file}, {"sha256", input.sha256}});
  }
  return list;
}

}  // namespace dwell
