#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/program.h"

namespace dwell {

/// How a G-code program is written, beside what it does.
struct GcodeStyle {
  /// G61, G61.1 or G64 with P in the preamble; nothing: the controller takes corners as it was set before.
  std::optional<PathMode> path_mode{};
  bool inches = false;                // G20, and F in inches a minute
  int block_numbers = 0;              // N in steps of this; 0 = none
  std::vector<std::string> before{};  // lines as they are, after the comments and before all else
  std::vector<std::string> after{};   // lines as they are, with the tool lifted, before the end
  std::size_t max_lines = 0;          // of a file; longer programs are written in parts as well; 0 = any
};

}  // namespace dwell
