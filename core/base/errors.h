#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace dwell {

/// What a user gave (file, option, job field) cannot be used. The message names the thing, the value and what
/// would be accepted. The command line turns it into exit code 2.
///
/// No code below runs/job knows how the user gave a value: by a flag, a field of a job file, a keyword of Python.
/// Messages therefore name an option by its plain name between backquotes, as in "`map pixel` = -1 mm; required > 0",
/// and whoever took the value from the user replaces the name by the one that the user knows: renamed(). Where one
/// value is at fault, the error also holds the name, the value and what is accepted by themselves.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// "`field` = value; required accepted". The value holds its unit.
  InputError(const std::string& field, const std::string& value, const std::string& accepted);
  /// The same parts in a sentence of their own, which names the field between backquotes.
  InputError(std::string field, std::string value, std::string accepted, const std::string& message);

  /// Empty where the message is not about one named value.
  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& accepted() const { return accepted_; }

  /// The same error about a value that the user knows as `name`.
  InputError renamed(const std::string& name) const;
  /// The same error with every option in the user's words: name_of("map pixel") is "--map-pixel" on a command line.
  InputError renamed(const std::function<std::string(const std::string&)>& name_of) const;

 private:
  std::string field_, value_, accepted_;
};

/// The text with every plain name between backquotes (lower-case words) replaced by what `name_of` returns for it.
std::string with_option_names(const std::string& text, const std::function<std::string(const std::string&)>& name_of);

/// The user interrupted the run (SIGINT, SIGTERM). Nothing has been written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

}  // namespace dwell
