#include "core/base/errors.h"

#include <algorithm>
#include <utility>

namespace dwell {
namespace {

/// Backquotes may also stand in the name of a file; only lower-case words between them are the name of an option.
bool is_plain_name(const std::string& text) {
  return !text.empty() && text.front() != ' ' && text.back() != ' ' &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == ' '; });
}

}  // namespace

std::string with_option_names(const std::string& text, const std::function<std::string(const std::string&)>& name_of) {
  std::string result;
  std::size_t from = 0;
  while (true) {
    const std::size_t open = text.find('`', from);
    const std::size_t close = open == std::string::npos ? open : text.find('`', open + 1);
    if (close == std::string::npos) return result + text.substr(from);
    const std::string name = text.substr(open + 1, close - open - 1);
    result += text.substr(from, open - from);
    if (is_plain_name(name)) {
      result += name_of(name);
      from = close + 1;
    } else {
      result += '`';
      from = open + 1;
    }
  }
}

InputError::InputError(const std::string& field, const std::string& value, const std::string& accepted)
    : InputError(field, value, accepted, "`" + field + "` = " + value + "; required " + accepted) {}

InputError::InputError(std::string field, std::string value, std::string accepted, const std::string& message)
    : std::runtime_error(message), field_(std::move(field)), value_(std::move(value)), accepted_(std::move(accepted)) {}

InputError InputError::renamed(const std::string& name) const {
  const auto name_of = [&](const std::string& other) { return other == field_ ? name : "`" + other + "`"; };
  return {name, value_, accepted_, with_option_names(what(), name_of)};
}

InputError InputError::renamed(const std::function<std::string(const std::string&)>& name_of) const {
  return {field_.empty() ? field_ : name_of(field_), value_, accepted_, with_option_names(what(), name_of)};
}

}  // namespace dwell
