#pragma once

#include <stdexcept>
#include <string>

namespace dwell {

/// What a user gave (file, option, job field) cannot be used. The message names the thing, the value and what
/// would be accepted. The command line turns it into exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

/// The user interrupted the run (SIGINT, SIGTERM). Nothing has been written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

}  // namespace dwell
