#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "runs/logs/log_alignment.h"
#include "runs/logs/log_columns.h"

namespace dwell::cli {

/// How a controller's log is to be read, the same in every command that takes one.
class LogArguments {
 public:
  LogArguments() = default;
  LogArguments(const LogArguments&) = delete;  // the command line holds references to it
  LogArguments& operator=(const LogArguments&) = delete;

  void add_to(CLI::App& command);
  /// Throws InputError.
  LogReading reading() const;
  double tolerance() const { return tolerance_; }
  /// The first of its flags that is given; empty: none.
  std::string given() const;

 private:
  std::string columns_;
  std::optional<double> period_;
  double tolerance_ = kLogTolerance;
  CLI::Option* tolerance_option_ = nullptr;
};

}  // namespace dwell::cli
