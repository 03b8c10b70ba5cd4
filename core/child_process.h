#pragma once

#include <functional>
#include <optional>
#include <string>

namespace dwell {

/// What `work` returns, done in a copy of this process; nothing if the copy came to harm: it crashed, ran out of memory
/// or used more than `cpu_seconds` of processor time. What it changes stays in the copy, and what it prints to standard
/// error is lost. `work` must not use threads (they are not copied) and must not throw.
/// Throws std::runtime_error if the system makes no process. Cost: a fork, and the answer is copied twice.
std::optional<std::string> output_of_child(const std::function<std::string()>& work, double cpu_seconds);

}  // namespace dwell
