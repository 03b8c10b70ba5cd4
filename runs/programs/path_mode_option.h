#pragma once

#include <string>

#include "core/motion/program.h"

namespace dwell {

/// How a program asks the machine to take corners.
struct PathModeOption {
  enum class Choice {
    Auto,   // as the machine does that the plan is made for; without one, nothing is written
    None,   // nothing is written
    Given,  // `mode`
  };
  Choice choice = Choice::Auto;
  PathMode mode{};

  bool operator==(const PathModeOption&) const = default;
};

/// Parses "auto", "none", "exact-stop", "exact-path", "blend" or "blend:0.05", the tolerance in mm. Throws InputError
/// naming the text and what is accepted.
PathModeOption parse_path_mode(const std::string& text);
std::string to_string(const PathModeOption& option);

}  // namespace dwell
