#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace dwell {

/// What a user gave (file, option, job field) cannot be used. The message names the thing, the value and what
/// would be accepted. The command line turns it into exit code 2.
///
/// Where one named value is at fault, the error also holds its parts, and core calls the value by its plain name
/// ("map pixel"), not by a flag: whoever took it from the user catches the error and throws it again with the name that
/// the user knows (`--map-pixel`, `map_pixel_mm` in a job file, a keyword of Python).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// "field: 'value'; accepted: ..."
  InputError(std::string field, std::string value, std::string accepted)
      : std::runtime_error(field + ": '" + value + "'; accepted: " + accepted),
        field_(std::move(field)),
        value_(std::move(value)),
        accepted_(std::move(accepted)) {}

  /// Empty where the message is not about one named value.
  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& accepted() const { return accepted_; }

  /// The same error about a value that the user knows as `field`.
  InputError renamed(const std::string& field) const { return InputError(field, value_, accepted_); }

 private:
  std::string field_, value_, accepted_;
};

/// The user interrupted the run (SIGINT, SIGTERM). Nothing has been written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

}  // namespace dwell
