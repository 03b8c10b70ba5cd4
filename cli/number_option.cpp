#include "cli/number_option.h"

#include <fmt/format.h>

#include <functional>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell::cli {
namespace {

constexpr double kLargestWhole = 9007199254740992.0;  // 2^53

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& accepted) {
  throw InputError(fmt::format("{}: '{}'; required {}", flag, text, accepted));
}

CLI::Option* add(CLI::App& command, const std::string& flag, const std::string& help,
                 const std::function<void(const std::string&)>& take) {
  const auto take_last = [take](const CLI::results_t& texts) { return take(texts.back()), true; };
  return command.add_option(flag, take_last, help)->expected(1);
}

}  // namespace

CLI::Option* add_number(CLI::App& command, const std::string& flag, double& into, const ValueRange& range,
                        const std::string& help) {
  return add(command, flag, help, [&into, flag, range](const std::string& text) {
    const auto value = finite_number(text);
    if (!value || !range.holds(*value)) refuse(flag, text, range.text());
    into = *value;
  });
}

CLI::Option* add_number(CLI::App& command, const std::string& flag, std::optional<double>& into,
                        const ValueRange& range, const std::string& help) {
  return add(command, flag, help, [&into, flag, range](const std::string& text) {
    const auto value = finite_number(text);
    if (!value || !range.holds(*value)) refuse(flag, text, range.text());
    into = *value;
  });
}

CLI::Option* add_whole_number(CLI::App& command, const std::string& flag, std::uint64_t& into,
                              const std::string& help) {
  return add(command, flag, help, [&into, flag](const std::string& text) {
    const auto value = finite_number(text);
    const bool in_range = value && *value >= 0.0 && *value <= kLargestWhole;
    if (!in_range || static_cast<double>(static_cast<std::uint64_t>(*value)) != *value) {
      refuse(flag, text, "a whole number from 0 to 2^53");
    }
    into = static_cast<std::uint64_t>(*value);
  });
}

}  // namespace dwell::cli
