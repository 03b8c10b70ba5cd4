#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace dwell {

/// What a child process may use.
struct ChildLimits {
  double cpu_seconds = 0.0;  // to whole seconds, at least one
  std::size_t bytes = 0;  // of memory, besides what this process has; no limit under a sanitizer, which takes terabytes
};

/// What `work` returns, done in a copy of this process; nothing if the copy came to harm: it crashed or went beyond its
/// limits. What it changes stays in the copy, and what it prints to standard error is lost. `work` must not use threads
/// (they are not copied) and must not throw.
/// Throws std::runtime_error if the system makes no process. Cost: a fork, and the answer is copied twice.
std::optional<std::string> output_of_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace dwell
